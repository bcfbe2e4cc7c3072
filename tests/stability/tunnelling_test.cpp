// Nothing passes through anything: fast spheres against thin walls that stand, move, or are meshes.
#include <gtest/gtest.h>

#include <cstdio>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;
constexpr float kRadius = 0.05f;  // m
constexpr float kSpeed = 100.0f;  // m/s: 33 radii a step
constexpr float kHalfThickness = 0.01f;

const Shape kSphere{Sphere{kRadius}, {}};

// A square of side x side triangles pairs in the plane x = 0 that faces -x.
LargeMesh wallMesh(int side, float half_extent) {
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      vertices.push_back(
          Vec3(0.0f, half_extent * (2.0f * static_cast<float>(i) / static_cast<float>(side) - 1.0f),
               half_extent * (2.0f * static_cast<float>(k) / static_cast<float>(side) - 1.0f)));
  const auto at = [side](int i, int k) { return static_cast<uint32_t>(i * (side + 1) + k); };
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k)
      for (uint32_t v : {at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)})
        indices.push_back(v);
  return buildLargeMesh(vertices, indices).mesh;
}

// Shoots `count` spheres in a grid along +x at whatever stands at x = 0, each from another distance, and
// counts those that are behind it after half a second.
int countPassed(World& world, int count, float wall_speed) {
  std::vector<BodyId> balls;
  const int side = 100;
  for (int i = 0; i < count; ++i) {
    const float y = 0.24f * static_cast<float>(i % side - side / 2),
                z = 0.24f * static_cast<float>(i / side - side / 2);
    const float x = -1.0f - 0.0137f * static_cast<float>(i % 113);
    balls.push_back(world.addBody({.name = "ball",
                                   .pose = {.position = Vec3(x, y + 0.1f, z + 0.1f)},
                                   .linear_velocity = Vec3(kSpeed, 0.0f, 0.0f),
                                   .shapes = {kSphere},
                                   .mass = 1.0f,
                                   .gravity_scale = 0.0f}));
  }
  for (int i = 0; i < 30; ++i) world.step(kStep);
  int passed = 0;
  for (const BodyId& id : balls)
    passed += world.states()[id.index].position.x() > wall_speed * 0.5f + 0.5f * kRadius;
  std::printf("  passed: %d of %d\n", passed, count);
  return passed;
}

BodyDef wall(const Shape& shape, MotionType type) {
  return {.name = "wall", .motion_type = type, .shapes = {shape}, .mass = 1e5f, .gravity_scale = 0.0f};
}

constexpr int kBalls = 10000;

TEST(Tunnelling, NoSpherePassesAThinFixedWall) {
  World world;
  world.addBody(wall({Box{Vec3(kHalfThickness, 20.0f, 20.0f)}, {}}, MotionType::Fixed));
  EXPECT_EQ(countPassed(world, kBalls, 0.0f), 0);
}

TEST(Tunnelling, NoSpherePassesAThinWallThatMovesTowardsIt) {
  World world;
  const BodyId id = world.addBody(wall({Box{Vec3(kHalfThickness, 20.0f, 20.0f)}, {}}, MotionType::Keyframe));
  world.state(id).linear_velocity = Vec3(-20.0f, 0.0f, 0.0f);
  EXPECT_EQ(countPassed(world, kBalls, -20.0f), 0);
}

TEST(Tunnelling, NoSpherePassesAMesh) {
  World world;
  world.addBody(wall({world.keep(wallMesh(40, 20.0f)), {}}, MotionType::Fixed));
  EXPECT_EQ(countPassed(world, kBalls, 0.0f), 0);
}

TEST(Tunnelling, TwoFastSpheresMeetHalfWay) {
  World world;
  const auto shoot = [&](float x) {
    return world.addBody({.name = "ball",
                          .pose = {.position = Vec3(x, 0.0f, 0.0f)},
                          .linear_velocity = Vec3(x < 0.0f ? kSpeed : -kSpeed, 0.0f, 0.0f),
                          .shapes = {kSphere},
                          .mass = 1.0f,
                          .gravity_scale = 0.0f});
  };
  const BodyId left = shoot(-5.3f), right = shoot(5.1f);
  for (int i = 0; i < 30; ++i) world.step(kStep);
  EXPECT_LT(world.states()[left.index].position.x(), world.states()[right.index].position.x());
}

}  // namespace
