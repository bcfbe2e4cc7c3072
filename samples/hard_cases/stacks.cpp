// HARD-01, 02, 03, 07, 09 and 11: towers, heavy loads on light boxes, boxes that begin inside each other, tiny boxes,
// and a tower ten kilometres from the origin.
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "samples/hard_cases/witness.h"
#include "samples/shared/builders.h"

namespace samples::hard_cases {
namespace {

using namespace pfx;

constexpr float kFriction = 0.6f;

void addFloor(World& world, const Vec3& at = Vec3::Zero()) {
  world.addBody({.name = "floor",
                 .pose = {.position = at - Vec3(0, 2, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{Vec3(60, 2, 60)})},
                 .restitution = 0.0f,
                 .friction = kFriction});
}

uint32_t addBox(World& world, const Vec3& at, const Vec3& half, float mass) {
  const BodyId id = world.addBody({.name = "box",
                                   .pose = {.position = at},
                                   .shapes = {shape(Box{half})},
                                   .mass = mass,
                                   .restitution = 0.0f,
                                   .friction = kFriction});
  return id.index;
}

// Unit boxes of 1 kg; the topmost has its own mass. Returns its index.
uint32_t addTower(World& world, const Vec3& foot, int boxes, float top_mass) {
  uint32_t top = 0;
  for (int i = 0; i < boxes; ++i)
    top = addBox(world, foot + Vec3(0, static_cast<float>(i) + 0.5f, 0), Vec3::Constant(0.5f),
                 i == boxes - 1 ? top_mass : 1.0f);
  return top;
}

struct Tower final : WitnessedScene {
  explicit Tower(float from_origin) : at(from_origin, 0, 0) {}
  const Vec3 at;
  uint32_t top = 0;

  void fill(World& world) override {
    addFloor(world, at);
    top = addTower(world, at, at.isZero() ? 50 : 10, 1.0f);
  }
  std::vector<Reading> readings(const World& world) const override {
    const double worse = at.isZero() ? 1.0 : 10.0;  // positions of floats are coarser far away
    return {{"drift of the top", "m", witness().drift(world, top), 0.005 * worse},
            {"deepest so far", "m", witness().penetration, 0.002 * worse},
            {"fastest box", "m/s", Witness::speed(world), 0.001 * worse}};
  }
};

struct HeavyLoads final : WitnessedScene {
  uint32_t ton = 0, hundredweight = 0;

  void fill(World& world) override {
    addFloor(world);
    ton = addTower(world, {-2.0f, 0, 0}, 5, 1000.0f);
    hundredweight = addTower(world, {2.0f, 0, 0}, 10, 100.0f);
  }
  std::vector<Reading> readings(const World& world) const override {
    return {{"drift of 1000 kg on 4 boxes", "m", witness().drift(world, ton), 0.01},
            {"drift of 100 kg on 9 boxes", "m", witness().drift(world, hundredweight), 0.01},
            {"deepest so far", "m", witness().penetration, 0.01}};
  }
};

// Eight plates, each 1.3 times as wide and twice as heavy as the one below.
struct InvertedPyramid final : WitnessedScene {
  uint32_t top = 0;

  void fill(World& world) override {
    addFloor(world);
    float half = 0.25f, mass = 1.0f;
    for (int i = 0; i < 8; ++i) {
      top = addBox(world, {0, 0.1f + 0.2f * static_cast<float>(i), 0}, {half, 0.1f, half}, mass);
      half *= 1.3f, mass *= 2.0f;
    }
  }
  std::vector<Reading> readings(const World& world) const override {
    const Vec3 up = world.states()[top].orientation * Vec3::UnitY();
    const double tilt = pfx::acos(std::min(1.0, double(up.y()))) * 180.0 / kPiDouble;
    return {{"tilt of the top plate", "degrees", tilt, 0.5}, {"deepest so far", "m", witness().penetration}};
  }
};

// Twenty boxes that begin half inside each other, two balls in the same place, and a box in a box.
struct Overlaps final : WitnessedScene {
  void fill(World& world) override {
    addFloor(world);
    for (int i = 0; i < 20; ++i)
      addBox(world,
             {-1.0f + 0.5f * static_cast<float>(i % 4), 0.5f + 0.5f * static_cast<float>(i / 4),
              0.25f * static_cast<float>(i % 2)},
             Vec3::Constant(0.5f), 1.0f);
    for (int i = 0; i < 2; ++i)
      world.addBody({.name = "ball", .pose = {.position = {5, 1, 0}}, .shapes = {shape(Sphere{0.5f})}});
    addBox(world, {-5, 1, 0}, Vec3::Constant(0.8f), 1.0f);
    addBox(world, {-5, 1, 0}, Vec3::Constant(0.4f), 1.0f);
  }
  std::vector<Reading> readings(const World&) const override {
    return {{"fastest so far", "m/s", witness().fastest, 5.0}};
  }
};

// The same pyramid of boxes of 5 mm and of 1 mm.
struct TinyPyramids final : WitnessedScene {
  static constexpr int kRows = 20;
  uint32_t tops[2] = {};

  void fill(World& world) override {
    addFloor(world);
    addPyramidOf(world, 0.005f, 0.0f, tops[0]);
    addPyramidOf(world, 0.001f, 0.04f, tops[1]);
  }
  static void addPyramidOf(World& world, float edge, float z, uint32_t& top) {
    for (int row = 0; row < kRows; ++row)
      for (int i = 0; i < kRows - row; ++i) {
        const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(kRows - 1 - row)) * 1.02f * edge;
        top = addBox(world, {x, (static_cast<float>(row) + 0.5f) * edge, z}, Vec3::Constant(0.5f * edge),
                     1000.0f * edge * edge * edge);
      }
  }
  std::vector<Reading> readings(const World& world) const override {
    return {{"drift of the top, edges of 5 mm", "edges", witness().drift(world, tops[0]) / 0.005, 0.2},
            {"drift of the top, edges of 1 mm", "edges", witness().drift(world, tops[1]) / 0.001, 0.2}};
  }
};

}  // namespace

std::vector<SceneEntry> stackScenes() {
  const std::string_view sample = "hard_cases";
  return {
      {.sample = sample,
       .name = "tower",
       .shows = "fifty boxes on top of each other, without sleep",
       .camera = {.target = {0, 24.5f, 0}, .distance = 84.0f, .yaw_deg = 30.0f, .pitch_deg = 6.0f},
       .frames = {0, 60, 300},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<Tower>(0.0f)); }},
      {.sample = sample,
       .name = "heavy_loads",
       .shows = "1000 kg on four boxes of 1 kg, 100 kg on nine",
       .camera = {.target = {0, 4.6f, 0}, .distance = 17.0f, .yaw_deg = 22.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 300},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<HeavyLoads>()); }},
      {.sample = sample,
       .name = "inverted_pyramid",
       .shows = "eight plates, each wider and twice as heavy as the one below",
       .camera = {.target = {0, 0.8f, 0}, .distance = 5.4f, .yaw_deg = 28.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 300},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<InvertedPyramid>()); }},
      {.sample = sample,
       .name = "overlaps",
       .shows = "boxes that begin inside each other part slowly, never with a bang",
       .camera = {.target = {0, 1.1f, 0}, .distance = 13.0f, .yaw_deg = 24.0f, .pitch_deg = 16.0f},
       .frames = {0, 20, 180},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<Overlaps>()); }},
      {.sample = sample,
       .name = "tiny_pyramids",
       .shows = "pyramids of boxes of 5 mm and of 1 mm: a length that an engine has fixed somewhere shows here",
       .camera = {.target = {0, 0.042f, 0.015f}, .distance = 0.24f, .yaw_deg = 24.0f, .pitch_deg = 16.0f},
       .frames = {0, 60, 300},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<TinyPyramids>()); }},
      {.sample = sample,
       .name = "far_tower",
       .shows = "ten boxes, ten kilometres from the origin, where floats are a millimetre apart",
       .camera = {.target = {10000.0f, 4.6f, 0}, .distance = 17.0f, .yaw_deg = 30.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 300},
       .world = {.center = {10000.0f, 0, 0}},
       .make = [] { return std::unique_ptr<Scene>(std::make_unique<Tower>(10000.0f)); }},
  };
}

}  // namespace samples::hard_cases
