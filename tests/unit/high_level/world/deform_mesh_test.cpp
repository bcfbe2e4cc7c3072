// Meshes that move under bodies: ACC-27, and that nothing falls through.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "pfx/high_level/world/mesh_motion.h"
#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;
constexpr float kGravity = 9.81f;

// A square sheet of cells x cells squares in the plane y = 0.
struct Sheet {
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  explicit Sheet(int cells, float half = 10.0f) {
    for (int i = 0; i <= cells; ++i)
      for (int k = 0; k <= cells; ++k)
        vertices.push_back(Vec3(2.0f * half * static_cast<float>(i) / static_cast<float>(cells) - half, 0,
                                2.0f * half * static_cast<float>(k) / static_cast<float>(cells) - half));
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const auto at = [&](int di, int dk) { return static_cast<uint32_t>((i + di) * (cells + 1) + k + dk); };
        indices.insert(indices.end(), {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)});
      }
  }
};

class DeformMesh : public testing::TestWithParam<LargeMeshType> {
 protected:
  const LargeMesh* add(World& world, const Sheet& sheet, float friction = 0.5f) {
    LargeMeshOptions options;
    options.type = GetParam();
    options.thickness = 1.0f;
    const LargeMesh* mesh = world.keep(buildLargeMesh(sheet.vertices, sheet.indices, options).mesh);
    world.addBody({.name = "sheet",
                   .motion_type = MotionType::Fixed,
                   .shapes = {Shape{mesh, {}}},
                   .restitution = 0.0f,
                   .friction = friction});
    return mesh;
  }
  static BodyId addBody(World& world, const Geometry& geometry, const Vec3& position, float friction = 0.5f) {
    return world.addBody({.name = "body",
                          .pose = {.position = position},
                          .shapes = {Shape{geometry, {}}},
                          .restitution = 0.0f,
                          .friction = friction});
  }
  static WorldDef def() {
    WorldDef d;
    d.gravity = Vec3(0, -kGravity, 0);
    return d;
  }
};

INSTANTIATE_TEST_SUITE_P(Types, DeformMesh, testing::Values(LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh));

// Point, and its triangle's corners moved at will: the contact stays at the same place of the triangle (SM-28).
TEST_P(DeformMesh, ContactsKeepTheirPlaceOnTheTriangle) {
  World world(def());
  Sheet sheet(8);
  const LargeMesh* mesh = add(world, sheet);
  addBody(world, Box{Vec3(0.4f, 0.3f, 0.5f)}, Vec3(0.3f, 0.3f, 0.2f));
  for (int i = 0; i < 10; ++i) world.step(kDt);
  ASSERT_FALSE(world.contactPairs().empty());
  const std::vector<ContactManifold> before(world.manifolds(world.contactPairs()[0]).begin(),
                                            world.manifolds(world.contactPairs()[0]).end());
  ASSERT_FALSE(before.empty());
  std::mt19937 random(3);
  std::uniform_real_distribution<float> shift(-0.2f, 0.2f);
  for (Vec3& v : sheet.vertices) {
    const float x = shift(random), y = shift(random);
    v += Vec3(x, y, shift(random));
  }
  world.deformMesh(mesh, sheet.vertices, 0.0f);
  const auto after = world.manifolds(world.contactPairs()[0]);
  ASSERT_EQ(after.size(), before.size());
  for (size_t m = 0; m < after.size(); ++m)
    for (int k = 0; k < after[m].num_points; ++k) {
      const ContactPoint& p = after[m].points[static_cast<size_t>(k)];
      const auto corner = facetVertices(*mesh, p.triangle);
      const Vec3 expected = corner[0] + p.barycentric.x() * (corner[1] - corner[0]) +
                            p.barycentric.y() * (corner[2] - corner[0]);
      EXPECT_LT((p.local_a - expected).norm(), 1e-3f);
    }
}

// SM-29, SM-30: within one step, under what rests and what falls; also when the mesh tilts and when it jumps back.
TEST_P(DeformMesh, NothingFallsThroughAMeshThatJumpsUpByHalfAMetre) {
  for (const float duration : {0.0f, kDt}) {
    World world(def());
    Sheet sheet(40);
    const LargeMesh* mesh = add(world, sheet);
    std::vector<BodyId> bodies;
    const std::array<Geometry, 4> geometries = {Sphere{0.25f}, Box{Vec3(0.3f, 0.2f, 0.25f)}, Capsule{0.3f, 0.2f},
                                                Cylinder{0.25f, 0.25f}};
    for (int i = 0; i < 36; ++i)
      bodies.push_back(addBody(world, geometries[static_cast<size_t>(i) % 4],
                               Vec3(1.3f * static_cast<float>(i % 6) - 3.2f, 0.3f + 0.05f * static_cast<float>(i % 7),
                                    1.3f * static_cast<float>(i / 6) - 3.2f)));
    float lowest = 1.0f;
    for (int i = 0; i < 180; ++i) {
      world.step(kDt);
      if (i % 30 == 10)
        for (Vec3& v : sheet.vertices) v.y() = 0.5f + 0.1f * v.x();
      if (i % 30 == 20)
        for (Vec3& v : sheet.vertices) v.y() = 0.0f;
      if (i % 30 == 10 || i % 30 == 20) {
        world.deformMesh(mesh, sheet.vertices, duration);
      }
      const float level = i % 30 >= 10 && i % 30 < 20 ? 0.5f : 0.0f;
      for (const BodyId id : bodies) {
        const Vec3& p = world.states()[id.index].position;
        if (std::max(std::abs(p.x()), std::abs(p.z())) < 10.0f)
          lowest = std::min(lowest, p.y() - (level > 0.0f ? level + 0.1f * p.x() : 0.0f));
      }
    }
    RecordProperty(duration > 0.0f ? "lowest_centre_thrown" : "lowest_centre_jump", std::to_string(lowest));
    EXPECT_GT(lowest, 0.0f) << "duration " << duration;  // the centre of each body stays above the surface
  }
}

// What lies in a valley has its centre below neither slope, as their normals see it, once they have passed it.
TEST_P(DeformMesh, WhatLiesInAValleyIsLiftedAsWell) {
  for (const Geometry& geometry : {Geometry(Sphere{0.15f}), Geometry(Cylinder{0.3f, 0.15f}), Geometry(Box{Vec3::Constant(0.12f)})}) {
    World world(def());
    Sheet sheet(8);
    for (Vec3& v : sheet.vertices) v.y() = 0.3f * std::abs(v.x());
    const LargeMesh* mesh = add(world, sheet);
    const BodyId body = addBody(world, geometry, Vec3(0.0f, 0.25f, 0.4f));
    for (int i = 0; i < 60; ++i) world.step(kDt);
    const float before = world.states()[body.index].position.y();
    ASSERT_GT(before, 0.05f);
    for (Vec3& v : sheet.vertices) v.y() += 0.5f;
    world.deformMesh(mesh, sheet.vertices, 0.0f);
    EXPECT_NEAR(world.states()[body.index].position.y() - before, 0.5f, 0.06f) << geometry.index();
    for (int i = 0; i < 60; ++i) world.step(kDt);
    EXPECT_NEAR(world.states()[body.index].position.y() - before, 0.5f, 0.02f) << geometry.index();
  }
}

// ACC-27 (a): N = m (g + a), here as the impulse of a step over dt.
TEST_P(DeformMesh, AFloorThatAcceleratesUpwardsWeighsWhatItShould) {
  World world(def());
  Sheet sheet(8);
  const LargeMesh* mesh = add(world, sheet);
  const BodyId box = addBody(world, Box{Vec3::Constant(0.5f)}, Vec3(0.3f, 0.5f, 0.2f));
  for (int i = 0; i < 60; ++i) world.step(kDt);
  constexpr float kAcceleration = 2.0f;
  float start_speed = 0.0f;
  for (int i = 1; i <= 60; ++i) {
    const float t = static_cast<float>(i) * kDt;
    for (Vec3& v : sheet.vertices) v.y() = 0.5f * kAcceleration * t * t;
    world.deformMesh(mesh, sheet.vertices, kDt);
    world.step(kDt);
    if (i == 30) start_speed = world.states()[box.index].linear_velocity.y();
  }
  const float gained = world.states()[box.index].linear_velocity.y() - start_speed;
  const float force = gained / (30.0f * kDt) + kGravity;  // N/kg, mean
  RecordProperty("force_per_kg", std::to_string(force));
  EXPECT_NEAR(force, kGravity + kAcceleration, 0.01f * (kGravity + kAcceleration));
  // The solver has moved the box on with the floor by one step of its velocity.
  EXPECT_NEAR(world.states()[box.index].position.y(), 0.5f + 0.5f * kAcceleration + kDt * kAcceleration, 0.01f);
}

// ACC-27 (b): a box on a surface that moves at 1 m/s reaches its speed after 1 / (mu g) seconds, not before.
TEST_P(DeformMesh, ASurfaceThatMovesSidewaysCarriesLikeAConveyor) {
  constexpr float kFriction = 0.3f;
  World world(def());
  Sheet sheet(8);
  const LargeMesh* mesh = add(world, sheet, kFriction);
  const BodyId box = addBody(world, Box{Vec3(0.5f, 0.2f, 0.5f)}, Vec3(-5.0f, 0.2f, 0.2f), kFriction);
  for (int i = 0; i < 60; ++i) world.step(kDt);
  const float expected = 1.0f / (kFriction * kGravity);  // s
  float reached = 0.0f;
  for (int i = 1; i <= 60; ++i) {
    for (Vec3& v : sheet.vertices) v.x() += kDt;
    world.deformMesh(mesh, sheet.vertices, kDt);
    world.step(kDt);
    const float speed = world.states()[box.index].linear_velocity.x();
    if (reached == 0.0f && speed > 0.99f) reached = static_cast<float>(i) * kDt;
    EXPECT_LT(speed, 1.02f);
  }
  RecordProperty("seconds", std::to_string(reached));
  EXPECT_NEAR(reached, expected, 1.5f * kDt);
}

// ACC-27 (c): on z = A sin(kx - wt) a box at the crest is left by the surface when A w^2 > g.
TEST_P(DeformMesh, ABoxLeavesAnOscillatingFloorWhenItFallsFasterThanTheBox) {
  for (const float share : {0.9f, 1.1f}) {
    World world(def());
    Sheet sheet(4);
    const LargeMesh* mesh = add(world, sheet);
    const BodyId box = addBody(world, Box{Vec3::Constant(0.5f)}, Vec3(0.3f, 0.5f, 0.2f));
    for (int i = 0; i < 30; ++i) world.step(kDt);
    constexpr float kFrequency = 6.0f;  // rad/s
    const float amplitude = share * kGravity / (kFrequency * kFrequency);
    float widest = 0.0f;
    for (int i = 1; i <= 240; ++i) {
      const float t = static_cast<float>(i) * kDt, y = amplitude * (1.0f - std::cos(kFrequency * t));
      for (Vec3& v : sheet.vertices) v.y() = y;
      world.deformMesh(mesh, sheet.vertices, kDt);
      world.step(kDt);
      // The solver has moved the surface on by one step of its velocity.
      const float surface = y + kDt * amplitude * kFrequency * std::sin(kFrequency * (t - 0.5f * kDt));
      if (i > 60) widest = std::max(widest, world.states()[box.index].position.y() - 0.5f - surface);
    }
    RecordProperty(share < 1.0f ? "gap_below" : "gap_above", std::to_string(widest));
    if (share < 1.0f)
      EXPECT_LT(widest, 0.01f);
    else
      EXPECT_GT(widest, 0.005f);
  }
}

TEST_P(DeformMesh, ASleepingBodyWakesWhenItsGroundMoves) {
  WorldDef d = def();
  d.sleeping = true;
  d.sleep_steps = 30;
  World world(d);
  Sheet sheet(8);
  const LargeMesh* mesh = add(world, sheet);
  const BodyId box = addBody(world, Box{Vec3::Constant(0.5f)}, Vec3(0.3f, 0.5f, 0.2f));
  for (int i = 0; i < 120; ++i) world.step(kDt);
  ASSERT_TRUE(world.states()[box.index].asleep);
  for (Vec3& v : sheet.vertices) v.y() = -0.5f;
  world.deformMesh(mesh, sheet.vertices, 0.0f);
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_NEAR(world.states()[box.index].position.y(), 0.0f, 0.01f);
}

TEST_P(DeformMesh, WrongVerticesAreRefusedAndChangeNothing) {
  World world(def());
  Sheet sheet(4);
  const LargeMesh* mesh = add(world, sheet);
  const Aabb bounds = mesh->bounds;
  auto vertices = sheet.vertices;
  vertices[3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(world.deformMesh(mesh, vertices, kDt), std::invalid_argument);
  vertices.pop_back();
  EXPECT_THROW(world.deformMesh(mesh, vertices, kDt), std::invalid_argument);
  EXPECT_THROW(world.deformMesh(mesh, sheet.vertices, -1.0f), std::invalid_argument);
  EXPECT_THROW(world.deformMesh(nullptr, sheet.vertices, kDt), std::invalid_argument);
  EXPECT_TRUE(mesh->bounds.contains(bounds) && bounds.contains(mesh->bounds));
}

TEST_P(DeformMesh, ASnapshotContinuesToTheBit) {
  World world(def());
  Sheet sheet(12);
  const LargeMesh* mesh = add(world, sheet);
  addBody(world, Sphere{0.4f}, Vec3(0.3f, 0.5f, 0.2f));
  const auto move = [&](World& w, const LargeMesh* m, int i) {
    for (Vec3& v : sheet.vertices) v.y() = 0.2f * std::sin(v.x() + 0.05f * static_cast<float>(i));
    w.deformMesh(m, sheet.vertices, kDt);
    w.step(kDt);
  };
  for (int i = 0; i < 30; ++i) move(world, mesh, i);
  std::vector<std::byte> bytes(world.snapshotBytes());
  world.snapshot(bytes);
  World copy;
  copy.restore(bytes);
  const auto* copied = std::get<const LargeMesh*>(copy.collidables()[0].shapes()[0].geometry);
  for (int i = 30; i < 60; ++i) {
    move(world, mesh, i);
    move(copy, copied, i);
  }
  EXPECT_EQ(copy.stateHash(), world.stateHash());
}

}  // namespace
