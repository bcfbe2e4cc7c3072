// Aligned, degenerate and very large or small shapes: always finite, never a missed overlap.
#include <array>
#include <cmath>
#include <vector>

#include "pfx/base_level/shape/convex_hull.h"
#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

std::vector<Vec3> cubeCorners(float half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  return corners;
}

void expectFinite(const ContactManifold& m) {
  EXPECT_TRUE(m.normal.allFinite());
  EXPECT_NEAR(m.normal.norm(), 1.0f, 1e-4f);
  for (int i = 0; i < m.num_points; ++i) {
    EXPECT_TRUE(m.points[i].local_a.allFinite() && m.points[i].local_b.allFinite());
    EXPECT_TRUE(std::isfinite(m.points[i].distance));
  }
}

// The 24 rotations that map a cube onto itself.
std::vector<Quat> cubeRotations() {
  std::vector<Quat> all;
  const float quarter = 1.57079633f;
  for (int face = 0; face < 6; ++face) {
    const Quat turn = face < 4 ? axisAngle(Vec3::UnitZ(), quarter * float(face))
                               : axisAngle(Vec3::UnitY(), face == 4 ? quarter : -quarter);
    for (int k = 0; k < 4; ++k) all.push_back(turn * axisAngle(Vec3::UnitX(), quarter * float(k)));
  }
  return all;
}

TEST(ExtremePairs, AlignedShapesOfUnitSizeOverlapTouchAndPartWhereTheyShould) {
  ConvexMesh cube;
  ASSERT_EQ(buildConvexMesh(cubeCorners(0.5f), cube), Error::Ok);
  const std::array<Shape, 5> shapes{Shape{Sphere{0.5f}, {}}, Shape{Box{Vec3::Constant(0.5f)}, {}},
                                    Shape{Capsule{0.25f, 0.25f}, {}}, Shape{Cylinder{0.5f, 0.5f}, {}},
                                    Shape{&cube, {}}};
  for (const Shape& a : shapes) {
    for (const Shape& b : shapes) {
      for (const Quat& turn : cubeRotations()) {
        // Every shape reaches from -0.5 to 0.5 along its X axis.
        for (const float gap : {-1.0f, -0.5f, -0.001f, 0.0f, 0.01f, 0.05f}) {
          const Transform pose_a{Vec3::Zero(), turn}, pose_b{turn * Vec3(1.0f + gap, 0.0f, 0.0f), turn};
          const ContactManifold m = collide(a, pose_a, b, pose_b, 0.02f);
          expectFinite(m);
          ASSERT_EQ(m.num_points > 0, gap < 0.02f);
          if (gap > -0.1f && gap < 0.02f) {
            EXPECT_NEAR(deepest(m), gap, 2e-6f);
            EXPECT_NEAR(m.normal.dot(turn.toRotationMatrix().col(0)), 1.0f, 1e-5f);
          }
        }
      }
    }
  }
}

TEST(ExtremePairs, BoxesFromAMillimetreToAKilometreStackAlike) {
  for (const float half : {5e-4f, 2.5e-3f, 0.5f, 500.0f}) {
    const Shape box{Box{Vec3::Constant(half)}, {}};
    ConvexMesh mesh;
    ASSERT_EQ(buildConvexMesh(cubeCorners(half), mesh), Error::Ok);
    for (const Shape& b : {box, Shape{&mesh, {}}}) {
      const Transform pose{Vec3(0.3f * half, 1.999f * half, -0.2f * half), axisAngle(Vec3::UnitY(), 0.3f)};
      const ContactManifold m = collide(box, {}, b, pose, 0.02f * half);
      ASSERT_EQ(m.num_points, 4);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(m.points[i].distance, -0.001f * half, 1e-6f * half);
    }
  }
}

TEST(ExtremePairs, SmallShapesOnAKilometreSlabKeepTheirFullManifold) {
  const Shape slab{Box{Vec3(500.0f, 5.0f, 500.0f)}, {}};
  ConvexMesh mesh;
  ASSERT_EQ(buildConvexMesh(cubeCorners(0.01f), mesh), Error::Ok);
  const Quat upright = axisAngle(Vec3::UnitZ(), 1.57079633f);
  const Transform pose{Vec3(100.0f, 5.01f, 200.0f), Quat::Identity()};
  const float tolerance = 3e-5f;  // two units in the last place of coordinates of hundreds of metres
  EXPECT_EQ(collide(slab, {}, {Sphere{0.01f}, {}}, pose, 1e-3f).num_points, 1);
  EXPECT_EQ(collide(slab, {}, {Box{Vec3::Constant(0.01f)}, {}}, pose, 1e-3f).num_points, 4);
  EXPECT_EQ(collide(slab, {}, {&mesh, {}}, pose, 1e-3f).num_points, 4);
  EXPECT_EQ(collide(slab, {}, {Capsule{0.02f, 0.01f}, {}}, pose, 1e-3f).num_points, 2);
  const ContactManifold standing =
      collide(slab, {}, {Cylinder{0.01f, 0.01f}, {}}, {pose.position, upright}, 1e-3f);
  EXPECT_EQ(standing.num_points, 4);
  for (int i = 0; i < standing.num_points; ++i) EXPECT_NEAR(standing.points[i].distance, 0.0f, tolerance);
}

TEST(ExtremePairs, PointsSegmentsAndSheetsAreFinite) {
  const std::array<Shape, 9> shapes{Shape{Sphere{0.0f}, {}},
                                    Shape{Box{Vec3::Zero()}, {}},
                                    Shape{Box{Vec3(1.0f, 0.0f, 1.0f)}, {}},
                                    Shape{Box{Vec3(1.0f, 0.0f, 0.0f)}, {}},
                                    Shape{Capsule{0.0f, 0.0f}, {}},
                                    Shape{Capsule{1.0f, 0.0f}, {}},
                                    Shape{Cylinder{0.0f, 1.0f}, {}},
                                    Shape{Cylinder{1.0f, 0.0f}, {}},
                                    Shape{Box{Vec3::Ones()}, {}}};
  Random random(31);
  for (const Shape& a : shapes) {
    for (const Shape& b : shapes) {
      expectFinite(collide(a, {}, b, {}, 0.1f));
      for (int i = 0; i < 50; ++i)
        expectFinite(collide(a, {}, b, {random.vector(1.0f), random.rotation()}, 0.1f));
    }
  }
}

TEST(ExtremePairs, ALargeMeshHasNoConvexPairFunction) {
  for (int i = 0; i < kNumShapeTypes; ++i) {
    EXPECT_EQ(pairFunction(ShapeType(i), ShapeType::LargeMesh), nullptr);
    for (int j = 0; j < 5 && i < 5; ++j) {
      const bool one = pairFunction(ShapeType(i), ShapeType(j)) != nullptr,
                 other = pairFunction(ShapeType(j), ShapeType(i)) != nullptr;
      EXPECT_TRUE(i == j ? one : one != other);
    }
  }
}

}  // namespace
}  // namespace pfx
