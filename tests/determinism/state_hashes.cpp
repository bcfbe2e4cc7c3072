// Prints the state hash of a few worlds after some seconds, one line a world: `name hash`.
//
// The same file is built into one program for each way of compiling the engine; all of them must print the
// same text. With 1, 2 and 4 workers each world must also agree with itself, or the program fails.
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "pfx/high_level/world/world.h"

namespace {

constexpr float kTimeStep = 1.0f / 60.0f;  // s
constexpr int kSteps = 120;

void addGround(pfx::World& world) {
  world.addBody({.pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = pfx::MotionType::Fixed,
                 .shapes = {{.geometry = pfx::Box{{30.0f, 1.0f, 30.0f}}}}});
}

void buildPyramid(pfx::World& world) {
  addGround(world);
  for (int row = 0; row < 8; ++row)
    for (int i = 0; i < 8 - row; ++i)
      world.addBody(
          {.pose = {.position = {1.1f * (static_cast<float>(i) - 0.5f * static_cast<float>(7 - row)),
                                 0.5f + static_cast<float>(row), 0.0f}},
           .shapes = {{.geometry = pfx::Box{{0.5f, 0.5f, 0.5f}}}}});
}

// Shapes of every kind that needs no mesh, tumbling onto one another: contact order and feature choice matter
// here.
void buildPile(pfx::World& world) {
  addGround(world);
  const pfx::Geometry kinds[] = {pfx::Sphere{0.4f}, pfx::Box{{0.5f, 0.3f, 0.4f}}, pfx::Capsule{0.4f, 0.25f},
                                 pfx::Cylinder{0.4f, 0.3f}};
  for (int i = 0; i < 64; ++i) {
    const float x = static_cast<float>(i % 4), y = static_cast<float>(i / 16),
                z = static_cast<float>(i / 4 % 4);
    const pfx::Quat turned(1.0f, 0.1f * x, 0.2f * y, 0.3f * z);
    world.addBody({.pose = {.position = {x - 1.5f + 0.1f * y, 1.0f + 1.2f * y, z - 1.5f - 0.1f * y},
                            .orientation = turned.normalized()},
                   .linear_velocity = {0.0f, -2.0f, 0.5f * x},
                   .angular_velocity = {z, 1.0f, -x},
                   .shapes = {{.geometry = kinds[i % 4]}},
                   .restitution = 0.1f * x});
  }
}

// A body that spins about its middle axis: the flip comes out of the rotation update alone.
void buildSpinner(pfx::World& world) {
  world.addBody({.angular_velocity = {0.01f, 8.0f, 0.01f},
                 .shapes = {{.geometry = pfx::Box{{0.2f, 0.6f, 1.0f}}}},
                 .gravity_scale = 0.0f});
}

struct Case {
  const char* name;
  void (*build)(pfx::World&);
  pfx::WorldDef def;
};

uint64_t hashAfterSteps(const Case& c, int workers, pfx::SimdLevel simd) {
  pfx::WorldDef def = c.def;
  def.workers = workers;
  def.simd = simd;
  pfx::World world(def);
  c.build(world);
  for (int i = 0; i < kSteps; ++i) world.step(kTimeStep);
  return world.stateHash();
}

struct Variant {
  const char* name;
  int workers;
  pfx::SimdLevel simd;
};

}  // namespace

int main(int argc, char** argv) {
  const bool once = argc > 1 && std::strcmp(argv[1], "--once") == 0;
  const Case cases[] = {
      {"pyramid_stable", buildPyramid, {}},
      {"pyramid_simple", buildPyramid, {.pipeline = pfx::Pipeline::Simple}},
      {"pyramid_sleeping", buildPyramid, {.sleeping = true, .sleep_steps = 60}},
      {"pile", buildPile, {}},
      {"pile_one_substep", buildPile, {.substeps = 1}},
      {"spinner", buildSpinner, {}},
  };
  const Variant variants[] = {
      {"two workers", 2, pfx::SimdLevel::Auto},
      {"four workers", 4, pfx::SimdLevel::Auto},
      {"the kernels for SSE2", 1, pfx::SimdLevel::Sse2},
  };
  for (const Case& c : cases) {
    const uint64_t hash = hashAfterSteps(c, 1, pfx::SimdLevel::Auto);
    for (const Variant& v : variants) {
      if (!once && hashAfterSteps(c, v.workers, v.simd) != hash) {
        std::fprintf(stderr, "%s: another hash with %s\n", c.name, v.name);
        return 1;
      }
    }
    std::printf("%s %016" PRIx64 "\n", c.name, hash);
  }
}
