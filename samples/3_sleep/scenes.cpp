// Sample 3_sleep: islands at rest fall asleep and cost nothing, until something touches one of their bodies.
#include "samples/all_in_world.h"
#include "samples/registry.h"
#include "samples/shared/basic_scenes.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

// Nine walls; a ball thrown at the middle one after all have fallen asleep wakes that one alone.
struct Walls final : Scene, AllInWorld {
  static constexpr uint64_t kThrowStep = 300;

  void build(World& world) override {
    addGround(world);
    for (int i = -4; i <= 4; ++i) addWall(world, Vec3(3.0f * static_cast<float>(i), 0.0f, 0.0f), {});
  }

  void beforeStep(World& world, float) override {
    if (world.stepCount() != kThrowStep) return;
    world.addBody({.name = "ball",
                   .pose = {.position = Vec3(0.0f, 2.0f, 14.0f)},
                   .linear_velocity = Vec3(0.0f, 1.0f, -25.0f),
                   .shapes = {shape(Sphere{0.6f})},
                   .mass = 4.0f,
                   .angular_damping = 3.0f});
  }
};

}  // namespace

std::vector<SceneEntry> sleepScenes() {
  const WorldDef world{.sleeping = true};
  std::vector<SceneEntry> scenes = basicScenes("3_sleep", world);
  scenes.push_back({.sample = "3_sleep",
                    .name = "walls",
                    .shows = "252 boxes in nine islands sleep; a ball wakes the one that it hits and no other",
                    .camera = {.target = Vec3(0.0f, 1.2f, 0.0f), .distance = 29.0f, .yaw_deg = 42.0f, .pitch_deg = 26.0f},
                    .frames = {0, 299, 360},
                    // Nothing here needs more than soft contacts; Newton's method would take 35 times as long.
                    .world = {.contact_solver = ContactSolver::Soft, .sleeping = true},
                    .make = [] { return std::unique_ptr<Scene>(new Walls); }});
  return scenes;
}

}  // namespace samples
