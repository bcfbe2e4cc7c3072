// Sample 2_stable carries pairs, contacts and impulses from step to step.
#include "samples/registry.h"
#include "samples/shared/basic_scenes.h"
#include "samples/shared/builders.h"
#include "samples/shared/drift.h"

namespace samples {
namespace {

using namespace pfx;

// The same tower twice: this world remembers, a second one beside it does not. Boxes redden as they drift.
struct SideBySide final : Scene {
  static constexpr TowerSize kSize{.layers = 8, .boxes = 18};

  void build(World& world) override {
    buildTower(world);
    drift_ = Drift(world);
    WorldDef def = world.def();
    def.pipeline = Pipeline::Simple;
    forgetful_ = World(def);
    buildTower(forgetful_);
  }

  void afterStep(World&, float dt) override { forgetful_.step(dt); }

  void draw(const World& world, Canvas& canvas) const override {
    constexpr float kBeside = 20.0f;  // m
    drawTitle("remembers contacts", world, Vec3::Zero(), canvas);
    drawTitle("remembers nothing", forgetful_, Vec3(kBeside, 0.0f, 0.0f), canvas);
    const std::vector<Color> colors = driftColors(forgetful_, drift_);
    for (uint32_t i = drift_.firstBody(); i < colors.size(); ++i) {
      if (colors[i] == 0) continue;
      const RigidState& s = forgetful_.states()[i];
      canvas.solid(forgetful_.collidables()[i].shapes()[0].geometry,
                   {s.position + Vec3(kBeside, 0.0f, 0.0f), s.orientation}, {colors[i]});
    }
  }

  std::vector<Color> bodyColors(const World& world) const override { return driftColors(world, drift_); }

  uint64_t stateHash() const override { return forgetful_.stateHash(); }

  std::vector<Reading> readings(const World& world) const override {
    return {{"drift with the cache", "mm", 1e3 * static_cast<double>(drift_.largest(world)), 10.0},
            {"drift without", "mm", 1e3 * static_cast<double>(drift_.largest(forgetful_))}};
  }

 private:
  static void buildTower(World& world) {
    addGround(world);
    addTower(world, kSize);
  }

  void drawTitle(std::string_view title, const World& world, const Vec3& offset, Canvas& canvas) const {
    const float top = 2.0f * static_cast<float>(kSize.layers) * kSize.half_extent;
    canvas.label(offset + Vec3(0.0f, top + 3.0f, 0.0f), title);
    canvas.label(offset + Vec3(0.0f, top + 1.6f, 0.0f), "drift " + millimetres(drift_.largest(world)));
  }

  World forgetful_;
  Drift drift_;
};

}  // namespace

std::vector<SceneEntry> stableScenes() {
  const WorldDef world{.pipeline = Pipeline::Stable};
  std::vector<SceneEntry> scenes = basicScenes("2_stable", world);
  scenes.push_back(
      {.sample = "2_stable",
       .name = "side_by_side",
       .shows = "the same tower twice: with remembered contacts and impulses it stands, without them it "
                "slides apart",
       .camera = {.target = Vec3(10.0f, 7.4f, 0.0f), .distance = 50.0f, .yaw_deg = 0.0f, .pitch_deg = 18.0f},
       .frames = {0, 300, 900},
       .world = world,
       .make = [] { return std::unique_ptr<Scene>(new SideBySide); }});
  return scenes;
}

}  // namespace samples
