// Sample 7_serialize: a run is saved, a damaged copy of the file is refused, and the good one goes on.
#include <stdexcept>
#include <vector>

#include "pfx/high_level/scene_file/scene_file.h"
#include "pfx/high_level/world/snapshot.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

void throwBallAtWall(World& world) {
  addGround(world);
  addWall(world, Vec3::Zero(), {.rows = 9});
  world.addBody({.name = "ball",
                 .pose = {.position = Vec3(-9.0f, 2.5f, 0.3f)},
                 .linear_velocity = Vec3(16.0f, 2.0f, 0.0f),
                 .shapes = {shape(Sphere{0.7f})},
                 .mass = 3.0f,
                 .angular_damping = 1.0f});
}

// The wall that falls in this scene was hit in another world, which was written as a scene file in flight.
struct Resumed final : Scene {
  static constexpr int kStepsBefore = 45;

  void build(World& world) override {
    World earlier(world.def());
    throwBallAtWall(earlier);
    for (int i = 0; i < kStepsBefore; ++i) earlier.step(kTimeStep);
    const std::string saved = writeScene(earlier);
    requireRefused(saved.substr(0, saved.size() / 2), world);
    buildScene(readScene({.xml = saved, .name = "saved.xml"}), world);
  }

  static void requireRefused(const std::string& damaged, World& world) {
    try {
      loadScene(SceneText{.xml = damaged, .name = "damaged.xml"}, world);
    } catch (const SceneError&) {
      return;  // with the place of the damage; the world is as it was
    }
    throw std::logic_error("half a file was taken for a scene");
  }
};

// Every 30 steps the world is written to memory and read back; the run is the same as without.
struct RoundTrip final : Scene {
  static constexpr uint64_t kEvery = 30;

  void build(World& world) override { throwBallAtWall(world); }

  void beforeStep(World& world, float) override {
    if (world.stepCount() % kEvery != 0) return;
    bytes_.resize(world.snapshotBytes());
    world.snapshot(bytes_);
    std::vector<std::byte> damaged = bytes_;
    damaged[damaged.size() / 3] ^= std::byte{1};
    try {
      world.restore(damaged);
      throw std::logic_error("a damaged snapshot was restored");
    } catch (const SnapshotError&) {
      world.restore(bytes_);
    }
  }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<SceneEntry> serializeScenes() {
  const CameraPose camera = {.target = Vec3(1.0f, 2.5f, 0.0f), .distance = 21.0f, .yaw_deg = 48.0f, .pitch_deg = 20.0f};
  return {{.sample = "7_serialize",
           .name = "resume",
           .shows = "the wall was hit in another world; this one read it from a file in flight and goes on",
           .camera = camera,
           .frames = {0, 30, 240},
           .world = {},
           .make = [] { return std::unique_ptr<Scene>(new Resumed); }},
          {.sample = "7_serialize",
           .name = "round_trip",
           .shows = "twice a second the world goes through a snapshot, and a damaged one is refused; nothing jumps",
           .camera = camera,
           .frames = {0, 60, 240},
           .world = {},
           .make = [] { return std::unique_ptr<Scene>(new RoundTrip); }}};
}

}  // namespace samples
