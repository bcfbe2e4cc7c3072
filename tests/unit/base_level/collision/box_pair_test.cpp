// Box against box: full manifolds at once, closed-form depths, steady choice of axes.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

Shape box(float x, float y, float z) { return {Box{Vec3(x, y, z)}, {}}; }

TEST(BoxPair, TouchingStackedBoxesGetFourPointsAtDistanceZero) {
  const Shape a = box(0.5f, 0.5f, 0.5f);
  const ContactManifold m = collide(a, {}, a, {Vec3(0.0f, 1.0f, 0.0f), Quat::Identity()});
  ASSERT_EQ(m.num_points, 4);
  EXPECT_NEAR((m.normal - Vec3::UnitY()).norm(), 0.0f, 1e-6f);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(m.points[i].distance, 0.0f, 1e-6f);
    EXPECT_NEAR(std::abs(m.points[i].local_a.x()), 0.5f, 1e-6f);
    EXPECT_NEAR(std::abs(m.points[i].local_a.z()), 0.5f, 1e-6f);
  }
}

TEST(BoxPair, GapBelowTheMarginGivesSpeculativePointsAndAboveItNone) {
  const Shape a = box(0.5f, 0.5f, 0.5f);
  const ContactManifold near = collide(a, {}, a, {Vec3(0.2f, 1.015f, 0.1f), Quat::Identity()}, 0.02f);
  ASSERT_EQ(near.num_points, 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(near.points[i].distance, 0.015f, 1e-6f);
  EXPECT_EQ(collide(a, {}, a, {Vec3(0.2f, 1.025f, 0.1f), Quat::Identity()}, 0.02f).num_points, 0);
}

TEST(BoxPair, CrossedEdgesHaveTheClosedFormDepth) {
  // Boxes turned by 45 degrees about X and about Z meet edge on edge: depth = 2 h sqrt(2) - d.
  const Shape a = box(1.0f, 1.0f, 1.0f);
  const float quarter = 0.785398163f;
  for (const float d : {2.7f, 2.8f, 2.828f}) {
    const Transform pose_a{Vec3::Zero(), axisAngle(Vec3::UnitX(), quarter)};
    const Transform pose_b{Vec3(0.0f, d, 0.0f), axisAngle(Vec3::UnitZ(), quarter)};
    const ContactManifold m = collide(a, pose_a, a, pose_b);
    ASSERT_EQ(m.num_points, 1);
    EXPECT_NEAR(m.points[0].distance, d - 2.0f * std::sqrt(2.0f), 1e-6f);
    EXPECT_NEAR(m.normal.y(), 1.0f, 1e-6f);
    expectConsistent(m, pose_a, pose_b, 1e-5f);
  }
}

TEST(BoxPair, BoxTurnedByFortyFiveDegreesOnAnotherKeepsTheAreaOfTheOctagon) {
  const Shape a = box(1.0f, 1.0f, 1.0f);
  const ContactManifold m =
      collide(a, {}, a, {Vec3(0.0f, 1.999f, 0.0f), axisAngle(Vec3::UnitY(), 0.785398163f)});
  ASSERT_EQ(m.num_points, 4);
  // The octagon's corners lie at radius sqrt(1 + tan^2(pi/8)); the largest quadrilateral of four of them is a
  // square.
  const float radius = std::sqrt(1.0f + 0.41421356f * 0.41421356f);
  Vec3 centroid = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    const Vec3& p = m.points[i].local_a;
    EXPECT_NEAR(std::hypot(p.x(), p.z()), radius, 1e-5f);
    centroid += 0.25f * p;
  }
  EXPECT_NEAR(centroid.x(), 0.0f, 1e-5f);
  EXPECT_NEAR(centroid.z(), 0.0f, 1e-5f);
}

TEST(BoxPair, IdenticalCentresAndBoxInsideBoxStillHaveAnAxis) {
  const Shape a = box(0.5f, 0.4f, 0.6f), inner = box(0.1f, 0.1f, 0.1f);
  const ContactManifold same = collide(a, {}, a, {});
  EXPECT_GT(same.num_points, 0);
  EXPECT_NEAR(deepest(same), -0.8f, 1e-5f);
  const ContactManifold inside =
      collide(a, {}, inner, {Vec3(0.05f, 0.1f, 0.0f), axisAngle(Vec3(1, 2, 3), 0.3f)});
  EXPECT_GT(inside.num_points, 0);
  EXPECT_LT(deepest(inside), -0.3f);
}

TEST(BoxPair, SwappingTheBoxesMirrorsTheManifold) {
  Random random(7);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const Shape a{Box{Vec3(0.2f, 0.3f, 0.4f) + Vec3::Constant(random.uniform(0.0f, 0.5f))}, {}};
    const Shape b{Box{Vec3(0.5f, 0.2f, 0.3f) + Vec3::Constant(random.uniform(0.0f, 0.5f))}, {}};
    const Transform pose_a{random.vector(0.6f), random.rotation()},
        pose_b{random.vector(0.6f), random.rotation()};
    const ContactManifold ab = collide(a, pose_a, b, pose_b), ba = collide(b, pose_b, a, pose_a);
    ASSERT_EQ(ab.num_points > 0, ba.num_points > 0);
    expectConsistent(ab, pose_a, pose_b, 2e-5f);
    if (ab.num_points == 0) continue;
    ++touching;
    EXPECT_NEAR(deepest(ab), deepest(ba), 2e-5f);
  }
  EXPECT_GT(touching, 1000);
}

TEST(BoxPair, AmongEquallyGoodEdgeAxesTheLastOneStays) {
  // A corner points down on an edge along X; two of its edges mirror each other and cross it at the same depth.
  const Shape a = box(0.5f, 0.5f, 0.5f);
  const Transform edge_up{Vec3::Zero(), axisAngle(Vec3::UnitX(), 0.785398163f)};
  const Quat corner_down = Quat::FromTwoVectors(Vec3(-1, -1, -1), Vec3(0, -1, 0));
  const Vec3 third = corner_down * Vec3::UnitZ();
  const Quat mirrored = axisAngle(Vec3::UnitY(), std::atan2(third.z(), third.x())) * corner_down;
  const float height = 0.5f * std::sqrt(2.0f) + 0.5f * std::sqrt(3.0f) - 0.01f;
  Random random(5);
  PairCache cache;
  uint32_t first = 0;
  int changes_without = 0;
  for (int frame = 0; frame < 200; ++frame) {
    const Quat jitter = axisAngle(random.direction(), 2e-4f);
    const Transform pose{Vec3(0.0f, height, 0.0f) + random.vector(1e-5f), jitter * mirrored};
    const ContactManifold m = collide(a, edge_up, a, pose, 0.02f, &cache);
    const ContactManifold forgetful = collide(a, edge_up, a, pose, 0.02f);
    ASSERT_EQ(m.num_points, 1);
    if (frame == 0) first = m.points[0].feature;
    EXPECT_EQ(m.points[0].feature, first);
    changes_without += forgetful.points[0].feature != first;
  }
  EXPECT_GT(changes_without, 20);
}

TEST(BoxPair, FeatureNamesPersistUnderSmallMotion) {
  const Shape a = box(0.5f, 0.5f, 0.5f);
  Random random(3);
  PairCache cache;
  std::set<uint32_t> first;
  for (int frame = 0; frame < 200; ++frame) {
    const Transform pose{Vec3(0.1f, 0.999f, 0.05f) + random.vector(1e-4f),
                         axisAngle(random.direction(), 1e-4f)};
    const ContactManifold m = collide(a, {}, a, pose, 0.02f, &cache);
    ASSERT_EQ(m.num_points, 4);
    std::set<uint32_t> names;
    for (int i = 0; i < 4; ++i) names.insert(m.points[i].feature);
    ASSERT_EQ(names.size(), 4u);
    if (frame == 0) first = names;
    EXPECT_EQ(names, first);
  }
}

TEST(BoxPair, FarFromTheOriginTheManifoldIsTheOneNearIt) {
  const Shape a = box(0.5f, 0.5f, 0.5f);
  const Vec3 far(8192.0f, -4096.0f, 16384.0f);  // powers of two: the poses themselves are exact
  const Transform pose_a{far, Quat::Identity()},
      pose_b{far + Vec3(0.25f, 0.984375f, 0.125f), Quat::Identity()};
  const ContactManifold m = collide(a, pose_a, a, pose_b);
  ASSERT_EQ(m.num_points, 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(m.points[i].distance, -0.015625f, 1e-6f);
}

}  // namespace
}  // namespace pfx
