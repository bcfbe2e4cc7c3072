// All bodies have the density of water, friction 0.5 and no bounce, on a fixed floor whose top is y = 0.
#include "samples/benchmarks/scenes.h"

namespace samples::benchmarks {
namespace {

constexpr float kDensity = 1000.0f;  // kg/m^3
constexpr float kFriction = 0.5f;

void addBox(pfx::World& world, const pfx::Vec3& position, float half) {
  world.addBody({.pose = {.position = position},
                 .shapes = {{.geometry = pfx::Box{pfx::Vec3::Constant(half)}}},
                 .mass = kDensity * 8.0f * half * half * half,
                 .restitution = 0.0f,
                 .friction = kFriction});
}

void addFloor(pfx::World& world) {
  world.addBody({.name = "floor",
                 .pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = pfx::MotionType::Fixed,
                 .shapes = {{.geometry = pfx::Box{{50.0f, 1.0f, 50.0f}}}},
                 .restitution = 0.0f,
                 .friction = kFriction});
}

}  // namespace

// Unit boxes, 0.1 m apart in a row, rows touching exactly: the start is the ideal state of rest.
void buildPyramid(pfx::World& world, int rows) {
  constexpr float kPitch = 1.1f;  // m
  addFloor(world);
  for (int row = 0; row < rows; ++row) {
    const int boxes = rows - row;
    for (int i = 0; i < boxes; ++i)
      addBox(world,
             {(static_cast<float>(i) - 0.5f * static_cast<float>(boxes - 1)) * kPitch,
              static_cast<float>(row) + 0.5f, 0.0f},
             0.5f);
  }
}

// Layers of boxes of 0.9 m at a pitch of 1 m, each shifted against the one below, dropped together.
void buildPile(pfx::World& world, int bodies_a_side) {
  const float centre = 0.5f * static_cast<float>(bodies_a_side - 1);
  addFloor(world);
  for (int layer = 0; layer < bodies_a_side; ++layer) {
    const float shift_x = layer % 2 == 1 ? 0.25f : -0.25f, shift_z = layer / 2 % 2 == 1 ? 0.25f : -0.25f;
    for (int i = 0; i < bodies_a_side; ++i)
      for (int k = 0; k < bodies_a_side; ++k)
        addBox(world,
               {static_cast<float>(i) - centre + shift_x, static_cast<float>(layer) + 0.95f,
                static_cast<float>(k) - centre + shift_z},
               0.45f);
  }
}

std::span<const Case> cases() {
  static constexpr Case kCases[] = {
      {"pyramid", "210 boxes in 20 rows: one island, ten contacts deep",
       [](pfx::World& w) { buildPyramid(w, 20); }, 600, true},
      {"pile", "1000 boxes dropped in a heap: broad phase and contacts",
       [](pfx::World& w) { buildPile(w, 10); }, 600, false},
  };
  return kCases;
}

}  // namespace samples::benchmarks
