// The table of the benchmark scenes, and the small ones: all bodies have the density of water, friction 0.5 and no
// bounce, on a fixed floor whose top is y = 0.
#include "samples/benchmarks/scenes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"

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

// Two waves across each other, and a rim outside 40 m that keeps bodies in.
float terrainHeight(float x, float z) {
  const float rim = std::max(0.0f, std::max(std::abs(x), std::abs(z)) - 40.0f);
  return 0.6f * pfx::sin(0.45f * x) * pfx::cos(0.4f * z) +
         0.15f * pfx::sin(1.7f * x + 0.3f) * pfx::sin(1.9f * z - 0.7f) + 0.08f * rim * rim;
}

pfx::LargeMesh makeTerrain() {
  constexpr uint32_t kCells = 100;  // a side, 1 m each, two triangles each
  std::vector<pfx::Vec3> vertices;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i <= kCells; ++i) {
    for (uint32_t k = 0; k <= kCells; ++k) {
      const float x = static_cast<float>(i) - 0.5f * kCells, z = static_cast<float>(k) - 0.5f * kCells;
      vertices.emplace_back(x, terrainHeight(x, z), z);
      if (i == kCells || k == kCells) continue;
      const uint32_t a = i * (kCells + 1) + k, b = a + kCells + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
  return pfx::buildLargeMesh(vertices, indices).mesh;
}

// Unit boxes, 0.1 m apart in a row, rows touching exactly: the start is the ideal state of rest.
void buildPyramid(pfx::World& world) {
  constexpr int kRows = 20;
  constexpr float kPitch = 1.1f;  // m
  addFloor(world);
  for (int row = 0; row < kRows; ++row) {
    const int boxes = kRows - row;
    for (int i = 0; i < boxes; ++i)
      addBox(world,
             {(static_cast<float>(i) - 0.5f * static_cast<float>(boxes - 1)) * kPitch,
              static_cast<float>(row) + 0.5f, 0.0f},
             0.5f);
  }
}

// Layers of boxes of 0.9 m at a pitch of 1 m, each shifted against the one below, dropped together.
void buildPile(pfx::World& world) {
  constexpr int kSide = 10;
  const float centre = 0.5f * static_cast<float>(kSide - 1);
  addFloor(world);
  for (int layer = 0; layer < kSide; ++layer) {
    const float shift_x = layer % 2 == 1 ? 0.25f : -0.25f, shift_z = layer / 2 % 2 == 1 ? 0.25f : -0.25f;
    for (int i = 0; i < kSide; ++i)
      for (int k = 0; k < kSide; ++k)
        addBox(world,
               {static_cast<float>(i) - centre + shift_x, static_cast<float>(layer) + 0.95f,
                static_cast<float>(k) - centre + shift_z},
               0.45f);
  }
}

// A grid of spheres above waves, thrown in all directions: each touches a few of 20,000 triangles.
void buildTerrain(pfx::World& world) {
  const pfx::LargeMesh* terrain = world.keep(makeTerrain());
  constexpr float kRadius = 0.4f, kSpeed = 3.0f;  // m, m/s
  constexpr float kGoldenAngle = 2.3999632f;      // rad; its multiples point everywhere
  world.addBody({.name = "terrain",
                 .motion_type = pfx::MotionType::Fixed,
                 .shapes = {{.geometry = terrain}},
                 .restitution = 0.0f,
                 .friction = kFriction});
  for (int n = 0; n < 1000; ++n) {
    const pfx::SinCos way = pfx::sincos(static_cast<float>(n) * kGoldenAngle);
    const float row = static_cast<float>(n / 32), column = static_cast<float>(n % 32);
    world.addBody({.pose = {.position = {2.0f * (row - 15.5f), 2.0f, 2.0f * (column - 15.5f)}},
                   .linear_velocity = {kSpeed * way.cos, 0.0f, kSpeed * way.sin},
                   .shapes = {{.geometry = pfx::Sphere{kRadius}}},
                   .mass = kDensity * 4.18879f * kRadius * kRadius * kRadius,
                   .restitution = 0.0f,
                   .friction = kFriction});
  }
}

// Forty chains of twenty capsules side by side, released from horizontal and from a slope by turns.
void buildChains(pfx::World& world) {
  constexpr float kHalf = 0.15f, kRadius = 0.1f, kPitch = 0.5f;  // m
  addFloor(world);
  for (int chain = 0; chain < 40; ++chain) {
    const bool level = chain % 2 == 0;
    const pfx::Quat turn = rotation(pfx::Vec3::UnitZ(), level ? 0.0f : -0.7f);
    const pfx::Vec3 top(0.0f, 11.0f, 0.6f * (static_cast<float>(chain) - 19.5f));
    pfx::BodyId last = world.addBody({.name = "hook",
                                      .pose = {.position = top},
                                      .motion_type = pfx::MotionType::Fixed,
                                      .shapes = {shape(pfx::Sphere{0.12f})},
                                      .filter_self = 0});
    for (int i = 0; i < 20; ++i) {
      const auto at = [&](float links) { return pfx::Vec3(top + turn * pfx::Vec3(kPitch * links, 0.0f, 0.0f)); };
      const pfx::BodyId next = world.addBody({.name = "link",
                                              .pose = {at(static_cast<float>(i) + 0.5f), turn},
                                              .shapes = {shape(pfx::Capsule{kHalf, kRadius})},
                                              .mass = 1.0f,
                                              .restitution = 0.0f,
                                              .friction = kFriction});
      world.addJoint({.body_a = last,
                      .body_b = next,
                      .params = pfx::BallJointParams{.anchor_point = at(static_cast<float>(i))}});
      last = next;
    }
  }
}

template <void (*Build)(pfx::World&)>
struct Built final : Scene {
  void build(pfx::World& world) override { Build(world); }
};

template <void (*Build)(pfx::World&)>
std::unique_ptr<Scene> make() {
  return std::make_unique<Built<Build>>();
}

}  // namespace

std::vector<Case> smallCases() {
  return {
      {.name = "pyramid",
       .shows = "210 boxes in 20 rows: one island, ten contacts deep",
       .make = make<buildPyramid>,
       .steps = 600,
       .starts_at_rest = true,
       .camera = {.target = {0.0f, 8.5f, 0.0f}, .distance = 36.0f, .yaw_deg = 28.0f, .pitch_deg = 10.0f},
       .frames = {0, 60, 300}},
      {.name = "pile",
       .shows = "1000 boxes dropped in a heap: broad phase and contacts",
       .make = make<buildPile>,
       .steps = 600,
       .starts_at_rest = false,
       .camera = {.target = {0.0f, 3.6f, 0.0f}, .distance = 34.0f, .yaw_deg = 32.0f, .pitch_deg = 22.0f},
       .frames = {0, 60, 240}},
      {.name = "chains",
       .shows = "40 chains of 20 capsules: joints with contacts among them",
       .make = make<buildChains>,
       .steps = 600,
       .starts_at_rest = false,
       .camera = {.target = {0.0f, 6.5f, 0.0f}, .distance = 36.0f, .yaw_deg = 35.0f, .pitch_deg = 16.0f},
       .frames = {0, 45, 150}},
      {.name = "terrain",
       .shows = "1000 spheres on 20,000 triangles: the mesh's hierarchy",
       .make = make<buildTerrain>,
       .steps = 600,
       .starts_at_rest = false,
       .camera = {.target = {0.0f, -4.0f, 0.0f}, .distance = 84.0f, .yaw_deg = 30.0f, .pitch_deg = 30.0f},
       .frames = {0, 60, 240}},
  };
}

std::span<const Case> cases() {
  static const std::vector<Case> table = [] {
    std::vector<Case> all;
    for (const auto family : {smallCases, largeCases})
      for (Case& c : family()) all.push_back(std::move(c));
    all.push_back(rainCase());
    return all;
  }();
  return table;
}

const Case* findCase(std::string_view name) {
  const auto found = std::ranges::find(cases(), name, &Case::name);
  return found == cases().end() ? nullptr : &*found;
}

}  // namespace samples::benchmarks

namespace samples {

std::vector<SceneEntry> benchmarkScenes() {
  std::vector<SceneEntry> entries;
  for (const benchmarks::Case& c : benchmarks::cases())
    entries.push_back({.sample = "benchmarks",
                       .name = c.name,
                       .shows = c.shows,
                       .camera = c.camera,
                       .frames = c.frames,
                       .world = c.world,
                       .make = c.make});
  return entries;
}

}  // namespace samples
