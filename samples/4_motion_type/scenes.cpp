// Sample 4_motion_type: what moves whom.
#include "pfx/base_level/math/trig.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

// A bar turned from outside sweeps through a wall. It never deviates, whatever it hits.
struct Keyframe final : Scene {
  static constexpr float kTurnPerStep = 0.02f;  // rad

  void build(World& world) override {
    addGround(world);
    bar_ = world.addBody({.name = "bar",
                          .pose = {.position = Vec3(0.0f, 2.0f, 0.0f), .orientation = rotation(Vec3::UnitY(), angle_)},
                          .motion_type = MotionType::Keyframe,
                          .shapes = {shape(Box{Vec3(5.0f, 0.25f, 0.5f)})}});
    addWall(world, Vec3(-3.0f, 0.0f, 0.0f), {.rows = 5});
  }

  void beforeStep(World& world, float dt) override {
    angle_ += kTurnPerStep;
    world.moveKeyframe(bar_, {Vec3(0.0f, 2.0f, 0.0f), rotation(Vec3::UnitY(), angle_)}, dt);
  }

 private:
  BodyId bar_;
  float angle_ = 0.5f * kPi;
};

}  // namespace

std::vector<SceneEntry> motionTypeScenes() {
  return {{.sample = "4_motion_type",
           .name = "keyframe",
           .shows = "a bar that is turned from outside sweeps a wall away and never deviates",
           .camera = {.target = Vec3(0.0f, 1.5f, 0.0f), .distance = 19.0f, .yaw_deg = 40.0f, .pitch_deg = 28.0f},
           .frames = {0, 90, 240},
           .world = {},
           .make = [] { return std::unique_ptr<Scene>(new Keyframe); }}};
}

}  // namespace samples
