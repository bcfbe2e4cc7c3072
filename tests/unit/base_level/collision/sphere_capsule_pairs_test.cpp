// Spheres and capsules against each other and boxes: closed forms.
#include <cmath>

#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

const Quat kUp = Quat(Eigen::AngleAxisf(1.57079633f, Vec3::UnitZ()));  // local X to world Y

TEST(SpherePairs, DistanceOfSpheresIsThatOfTheCentresLessTheRadii) {
  const Shape a{Sphere{0.5f}, {}}, b{Sphere{0.25f}, {}};
  const ContactManifold m = collide(a, {}, b, {Vec3(0.0f, 0.6f, 0.3f), Quat::Identity()});
  ASSERT_EQ(m.num_points, 1);
  EXPECT_NEAR(m.points[0].distance, std::sqrt(0.45f) - 0.75f, 1e-6f);
}

TEST(SpherePairs, CoincidentSpheresPushApartAlongAFixedAxis) {
  const Shape a{Sphere{0.5f}, {}};
  const ContactManifold m = collide(a, {}, a, {});
  ASSERT_EQ(m.num_points, 1);
  EXPECT_NEAR(m.points[0].distance, -1.0f, 1e-6f);
  EXPECT_NEAR(m.normal.norm(), 1.0f, 1e-6f);
}

TEST(SpherePairs, SphereOutsideAndInsideABoxHasTheClosedForm) {
  const Shape sphere{Sphere{0.2f}, {}}, box{Box{Vec3(1.0f, 2.0f, 3.0f)}, {}};
  const ContactManifold corner = collide(box, {}, sphere, {Vec3(1.1f, 2.1f, 3.1f), Quat::Identity()});
  ASSERT_EQ(corner.num_points, 1);
  EXPECT_NEAR(corner.points[0].distance, 0.1f * std::sqrt(3.0f) - 0.2f, 1e-6f);
  EXPECT_NEAR(corner.normal.dot(Vec3::Ones().normalized()), 1.0f, 1e-6f);
  const ContactManifold inside = collide(sphere, {Vec3(0.7f, 0.0f, 0.0f), Quat::Identity()}, box, {});
  ASSERT_EQ(inside.num_points, 1);
  EXPECT_NEAR(inside.points[0].distance, -0.3f - 0.2f, 1e-6f);
  EXPECT_NEAR(inside.normal.x(), -1.0f, 1e-6f);
}

TEST(CapsulePairs, ParallelCapsulesTouchAlongALine) {
  const Shape a{Capsule{1.0f, 0.3f}, {}};
  const ContactManifold m = collide(a, {}, a, {Vec3(0.5f, 0.59f, 0.0f), Quat::Identity()});
  ASSERT_EQ(m.num_points, 2);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(m.points[i].distance, -0.01f, 1e-6f);
  EXPECT_NEAR(std::abs(m.points[0].local_a.x() - m.points[1].local_a.x()), 1.5f, 1e-5f);
}

TEST(CapsulePairs, CrossedCollinearAndCoincidentCapsulesHaveTheSegmentDistance) {
  const Shape a{Capsule{1.0f, 0.3f}, {}};
  const ContactManifold crossed = collide(a, {}, a, {Vec3(0.0f, 0.5f, 0.0f), axisAngle(Vec3::UnitY(), 1.2f)});
  ASSERT_EQ(crossed.num_points, 1);
  EXPECT_NEAR(crossed.points[0].distance, -0.1f, 1e-6f);
  const ContactManifold end = collide(a, {}, a, {Vec3(2.5f, 0.0f, 0.0f), Quat::Identity()});
  ASSERT_EQ(end.num_points, 1);
  EXPECT_NEAR(end.points[0].distance, -0.1f, 1e-6f);
  const ContactManifold same = collide(a, {}, a, {});
  ASSERT_GE(same.num_points, 1);
  EXPECT_NEAR(deepest(same), -0.6f, 1e-6f);
}

TEST(CapsulePairs, CapsuleLyingOnABoxGetsBothEndsAndStandingOne) {
  const Shape capsule{Capsule{0.5f, 0.2f}, {}}, box{Box{Vec3(2.0f, 0.5f, 2.0f)}, {}};
  const ContactManifold lying =
      collide(box, {}, capsule, {Vec3(0.1f, 0.695f, 0.3f), axisAngle(Vec3::UnitY(), 0.4f)});
  ASSERT_EQ(lying.num_points, 2);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(lying.points[i].distance, -0.005f, 1e-5f);
  const ContactManifold standing = collide(box, {}, capsule, {Vec3(0.1f, 1.195f, 0.3f), kUp});
  ASSERT_EQ(standing.num_points, 1);
  EXPECT_NEAR(standing.points[0].distance, -0.005f, 1e-5f);
}

TEST(CapsulePairs, CapsuleHangingOverTheEdgeOfABoxIsHeldUpToTheEdge) {
  const Shape capsule{Capsule{1.0f, 0.2f}, {}}, box{Box{Vec3(1.0f, 0.5f, 1.0f)}, {}};
  const ContactManifold m = collide(box, {}, capsule, {Vec3(0.5f, 0.7f, 0.0f), Quat::Identity()});
  ASSERT_EQ(m.num_points, 2);
  const float lo = std::min(m.points[0].local_a.x(), m.points[1].local_a.x());
  const float hi = std::max(m.points[0].local_a.x(), m.points[1].local_a.x());
  EXPECT_NEAR(lo, -0.5f, 1e-4f);
  EXPECT_NEAR(hi, 1.0f, 1e-4f);
}

TEST(CapsulePairs, CapsuleThroughTheMiddleOfABoxIsPushedOutTheShortWay) {
  const Shape capsule{Capsule{2.0f, 0.1f}, {}}, box{Box{Vec3(1.0f, 0.3f, 1.0f)}, {}};
  const ContactManifold m = collide(box, {}, capsule, {Vec3(0.0f, 0.1f, 0.0f), Quat::Identity()});
  ASSERT_GE(m.num_points, 1);
  EXPECT_NEAR(m.normal.y(), 1.0f, 1e-5f);
  EXPECT_NEAR(deepest(m), -0.3f, 1e-5f);
}

TEST(CapsulePairs, CapsuleAlongAnEdgeOfABoxGetsBothEndsOfTheCommonStretch) {
  const Shape box{Box{Vec3(1.0f, 1.0f, 1.0f)}, {}}, capsule{Capsule{0.6f, 0.2f}, {}};
  const Vec3 n = Vec3(0.0f, 1.0f, 1.0f).normalized();  // from the edge y = z = 1, along X
  for (const float shift : {0.0f, 0.7f}) {
    for (const float turn : {0.0f, 0.01f, -0.02f}) {
      const Vec3 center = Vec3(shift, 1.0f, 1.0f) + 0.199f * n;
      const Transform pose{center, axisAngle(n, turn)};
      const ContactManifold m = collide(box, {}, capsule, pose, 0.01f);
      ASSERT_EQ(m.num_points, 2) << shift << " " << turn;
      EXPECT_NEAR((m.normal - n).norm(), 0.0f, 0.01f);
      const float x0 = m.points[0].local_a.x(), x1 = m.points[1].local_a.x();
      EXPECT_NEAR(std::min(x0, x1), shift - 0.6f, 2e-3f);
      EXPECT_NEAR(std::max(x0, x1), std::min(1.0f, shift + 0.6f), 2e-3f);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(m.points[i].distance, -0.001f, 1e-4f);
      expectConsistent(m, {}, pose, 1e-5f);
    }
  }
}

TEST(CapsulePairs, CapsuleAcrossAnEdgeOfABoxGetsOnePoint) {
  const Shape box{Box{Vec3(1.0f, 1.0f, 1.0f)}, {}}, capsule{Capsule{0.6f, 0.2f}, {}};
  const Vec3 n = Vec3(0.0f, 1.0f, 1.0f).normalized();
  const ContactManifold m =
      collide(box, {}, capsule, {Vec3(0.0f, 1.0f, 1.0f) + 0.199f * n, axisAngle(n, 0.5f)}, 0.01f);
  EXPECT_EQ(m.num_points, 1);
}

}  // namespace
}  // namespace pfx
