// Contacts where meshes of two bodies meet: what the surface as a whole has stays, what only one of them has goes.
#include <gtest/gtest.h>

#include <cmath>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

// Half a plane, x < 0, that ends in an open rim at x = 0.
LargeMesh halfPlane() {
  auto soup = pfx_test::flatGrid(10, 0.5f);
  for (Vec3& v : soup.vertices) v.x() -= 2.5f;
  return buildLargeMesh(soup.vertices, soup.indices).mesh;
}

Quat aboutZ(float angle) { return Quat(Eigen::AngleAxisf(angle, Vec3::UnitZ())); }

struct Ground {
  Transform left, right;  // of half planes; the right one is turned about y
};

World makeWorld(const LargeMesh& half, const Ground& g) {
  World world({.gravity = Vec3::Zero()});
  const Transform turned{Vec3::Zero(), Quat(Eigen::AngleAxisf(3.14159265f, Vec3::UnitY()))};
  for (const Transform& pose : {g.left, g.right * turned})
    world.addBody({.pose = pose, .motion_type = MotionType::Fixed, .shapes = {{&half, {}}}});
  return world;
}

// Normals on the body after one step at rest.
std::vector<Vec3> normals(World& world, const Geometry& geometry, const Vec3& position) {
  const BodyId id = world.addBody({.pose = {.position = position}, .shapes = {{geometry, {}}}});
  world.step(1.0f / 60.0f);
  std::vector<Vec3> found;
  for (const Pair& pair : world.contactPairs())
    for (const ContactManifold& m : world.manifolds(pair))
      found.push_back(pair.body_b == id.index ? m.normal : Vec3(-m.normal));
  return found;
}

TEST(Seams, aBallBeforeAFlatSeamMeetsNoRim) {
  const LargeMesh half = halfPlane();
  for (const float x : {-0.05f, -0.01f, 0.0f, 0.01f, 0.05f}) {
    World world = makeWorld(half, {});
    for (const Vec3& n : normals(world, Sphere{0.2f}, Vec3(x, 0.2f, 0.1f))) EXPECT_GT(n.y(), 0.9999f);
  }
}

TEST(Seams, aBallOnARidgeOfTwoMeshesKeepsTheNormalsBetweenTheirSlopes) {
  const LargeMesh half = halfPlane();
  // Both sides fall away by 0.3 rad from the line x = y = 0.
  const Ground ridge{{Vec3::Zero(), aboutZ(0.3f)}, {Vec3::Zero(), aboutZ(-0.3f)}};
  for (const float angle : {0.0f, 0.1f, -0.2f}) {
    World world = makeWorld(half, ridge);
    const Vec3 n(std::sin(angle), std::cos(angle), 0.0f);
    const auto found = normals(world, Sphere{0.2f}, 0.1999f * n + Vec3(0, 0, 0.1f));
    ASSERT_FALSE(found.empty());
    for (const Vec3& m : found) EXPECT_LT((m - n).norm(), 2e-3f);
  }
}

TEST(Seams, aBallInAValleyOfTwoMeshesTouchesBothSlopes) {
  const LargeMesh half = halfPlane();
  const Ground valley{{Vec3::Zero(), aboutZ(-0.3f)}, {Vec3::Zero(), aboutZ(0.3f)}};
  World world = makeWorld(half, valley);
  const auto found = normals(world, Sphere{0.2f}, Vec3(0, 0.1999f / std::cos(0.3f), 0.1f));
  ASSERT_EQ(found.size(), 2u);
  for (const Vec3& n : found) EXPECT_NEAR(n.y(), std::cos(0.3f), 1e-4f);
}

TEST(Seams, aBoxInACornerOfFloorAndWallTouchesBoth) {
  const LargeMesh half = halfPlane();
  const Ground corner{{}, {Vec3::Zero(), aboutZ(1.57079633f)}};  // the wall rises from x = 0
  World world = makeWorld(half, corner);
  bool floor = false, wall = false;
  for (const Vec3& n : normals(world, Box{Vec3(0.2f, 0.2f, 0.2f)}, Vec3(-0.1999f, 0.1999f, 0.1f))) {
    floor |= n.y() > 0.999f;
    wall |= n.x() < -0.999f;
  }
  EXPECT_TRUE(floor);
  EXPECT_TRUE(wall);
}

TEST(Seams, aRimThatNothingContinuesStays) {
  const LargeMesh half = halfPlane();
  World world = makeWorld(half, {{}, {Vec3(3, 0, 0), Quat::Identity()}});  // a gap of 3 m
  const Vec3 n = Vec3(1, 1, 0).normalized();
  const auto found = normals(world, Sphere{0.2f}, 0.199f * n + Vec3(0, 0, 0.1f));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT((found[0] - n).norm(), 1e-4f);
}

}  // namespace
}  // namespace pfx
