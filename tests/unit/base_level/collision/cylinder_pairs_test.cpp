// Cylinders: caps give faces, sides give lines, rims give points; closed forms of depth.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/shape/convex_hull.h"
#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

const Quat kUpright = axisAngle(Vec3::UnitZ(), 1.57079633f);  // local X to world Y
const Shape kCylinder{Cylinder{0.5f, 0.3f}, {}};
const Shape kFloor{Box{Vec3(5.0f, 0.5f, 5.0f)}, {Vec3(0.0f, -0.5f, 0.0f), Quat::Identity()}};

void expectDistances(const ContactManifold& m, int count, float distance, float tolerance) {
  ASSERT_EQ(m.num_points, count);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(m.points[i].distance, distance, tolerance);
}

TEST(CylinderPairs, StandingOnABoxTheCapGetsFourRimPointsAQuarterTurnApart) {
  for (const float height : {0.51f, 0.5f, 0.499f}) {
    const Transform pose{Vec3(0.3f, height, -0.2f), kUpright};
    const ContactManifold m = collide(kFloor, {}, kCylinder, pose);
    expectDistances(m, 4, height - 0.5f, 2e-6f);
    Vec3 center = Vec3::Zero();
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(m.points[i].local_b.tail<2>().norm(), 0.3f, 1e-5f);
      center += 0.25f * m.points[i].local_b;
    }
    EXPECT_NEAR(center.tail<2>().norm(), 0.0f, 1e-5f);
    EXPECT_NEAR(m.normal.y(), 1.0f, 1e-6f);
  }
}

TEST(CylinderPairs, LyingOnABoxTheSideGetsBothEnds) {
  for (const float turn : {0.0f, 0.3f, 0.785398163f, 1.57079633f}) {
    const Transform pose{Vec3(0.3f, 0.299f, -0.2f), axisAngle(Vec3::UnitY(), turn)};
    const ContactManifold m = collide(kFloor, {}, kCylinder, pose);
    expectDistances(m, 2, -0.001f, 2e-6f);
    EXPECT_NEAR(std::abs(m.points[0].local_b.x() - m.points[1].local_b.x()), 1.0f, 1e-5f);
  }
}

TEST(CylinderPairs, TiltedCoinTouchesWithTheLowestRimPoint) {
  const float tilt = 0.4f;
  const Quat turn = axisAngle(Vec3::UnitX(), tilt) * kUpright;
  const float lowest = 0.5f * std::cos(tilt) + 0.3f * std::sin(tilt);
  const ContactManifold m = collide(kFloor, {}, kCylinder, {Vec3(0.0f, lowest - 0.002f, 0.0f), turn});
  ASSERT_EQ(m.num_points, 1);
  EXPECT_NEAR(m.points[0].distance, -0.002f, 1e-5f);
  EXPECT_NEAR(m.normal.y(), 1.0f, 1e-5f);
}

TEST(CylinderPairs, HalfOverTheEdgeOfATableThePatchIsTheHalfDisc) {
  const Shape table{Box{Vec3(1.0f, 0.5f, 1.0f)}, {Vec3(-1.0f, -0.5f, 0.0f), Quat::Identity()}};
  const ContactManifold m = collide(table, {}, kCylinder, {Vec3(0.0f, 0.499f, 0.0f), kUpright});
  expectDistances(m, 4, -0.001f, 1e-5f);
  float lo = 1.0f, hi = -1.0f, wide = 0.0f;
  for (int i = 0; i < 4; ++i) {
    lo = std::min(lo, m.points[i].local_a.x());
    hi = std::max(hi, m.points[i].local_a.x());
    wide = std::max(wide, std::abs(m.points[i].local_a.z()));
  }
  EXPECT_NEAR(hi, 0.0f, 1e-4f);
  EXPECT_LE(lo, -0.2f);
  EXPECT_NEAR(wide, 0.3f, 1e-4f);
}

TEST(CylinderPairs, StackedCylindersTouchWithFourPointsAlsoWhenShifted) {
  for (const float shift : {0.0f, 0.1f, 0.4f}) {
    const Transform lower{Vec3(0.0f, 0.5f, 0.0f), kUpright}, upper{Vec3(shift, 1.499f, 0.0f), kUpright};
    const ContactManifold m = collide(kCylinder, lower, kCylinder, upper);
    expectDistances(m, 4, -0.001f, 2e-6f);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LE(m.points[i].local_a.tail<2>().norm(), 0.3f + 1e-4f);
      EXPECT_LE(m.points[i].local_b.tail<2>().norm(), 0.3f + 1e-4f);
    }
  }
}

TEST(CylinderPairs, SideBySideAndCrossedCylindersHaveTheClosedForm) {
  expectDistances(collide(kCylinder, {}, kCylinder, {Vec3(0.2f, 0.59f, 0.0f), Quat::Identity()}), 2, -0.01f,
                  1e-6f);
  const Transform crossed{Vec3(0.0f, 0.595f, 0.0f), axisAngle(Vec3::UnitY(), 1.0f)};
  expectDistances(collide(kCylinder, {}, kCylinder, crossed), 1, -0.005f, 2e-6f);
}

TEST(CylinderPairs, CapsuleLyingAcrossACapGetsTwoPoints) {
  const Shape capsule{Capsule{1.0f, 0.1f}, {}};
  const Transform upright{Vec3(0.0f, 0.5f, 0.0f), kUpright},
      lying{Vec3(0.0f, 1.099f, 0.0f), Quat::Identity()};
  const ContactManifold m = collide(kCylinder, upright, capsule, lying);
  expectDistances(m, 2, -0.001f, 2e-6f);
  EXPECT_NEAR((m.points[0].local_b - m.points[1].local_b).norm(), 0.6f, 1e-4f);
}

TEST(CylinderPairs, CylinderOnAConvexMeshIsTheOneOnTheBoxOfItsShape) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? 5.0f : -5.0f, i & 2 ? 0.0f : -1.0f, i & 4 ? 5.0f : -5.0f);
  ConvexMesh mesh;
  ASSERT_EQ(buildConvexMesh(corners, mesh), Error::Ok);
  const Shape floor{&mesh, {}};
  expectDistances(collide(floor, {}, kCylinder, {Vec3(0.3f, 0.499f, -0.2f), kUpright}), 4, -0.001f, 2e-6f);
  expectDistances(collide(floor, {}, kCylinder, {Vec3(0.3f, 0.299f, -0.2f), Quat::Identity()}), 2, -0.001f,
                  2e-6f);
}

TEST(CylinderPairs, ARollingCylinderKeepsItsFeatureNamesAndNormal) {
  ContactManifold last;
  for (int frame = 0; frame < 100; ++frame) {
    const Quat turn = axisAngle(Vec3::UnitX(), 0.02f * float(frame));
    const ContactManifold m =
        collide(kFloor, {}, kCylinder, {Vec3(0.0f, 0.2999f, 0.006f * float(frame)), turn});
    ASSERT_EQ(m.num_points, 2);
    EXPECT_NEAR(m.normal.y(), 1.0f, 1e-6f);
    if (frame > 0) {
      EXPECT_EQ(m.points[0].feature, last.points[0].feature);
      EXPECT_EQ(m.points[1].feature, last.points[1].feature);
    }
    last = m;
  }
}

}  // namespace
}  // namespace pfx
