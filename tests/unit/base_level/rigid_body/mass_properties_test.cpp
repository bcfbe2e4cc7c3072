// Mass properties against closed forms and against the same solid cut into parts.
#include "pfx/base_level/rigid_body/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace pfx {
namespace {

constexpr float kPi = 3.14159265358979f;

TEST(MassProperties, SphereHasTwoFifthsOfItsMassTimesRadiusSquared) {
  const MassProperties m = massProperties(Geometry(Sphere{0.5f}), 1000.0f);
  EXPECT_NEAR(m.mass, 1000.0f * kPi / 6.0f, 1e-3f);
  EXPECT_NEAR(m.inertia(0, 0), 0.4f * m.mass * 0.25f, 1e-3f);
  EXPECT_NEAR(m.inertia(1, 2), 0.0f, 1e-6f);
}

TEST(MassProperties, CapsuleWithoutTubeIsASphereAndCylinderHasTheClosedForm) {
  const MassProperties ball = massProperties(Geometry(Sphere{0.3f}), 10.0f);
  const MassProperties capsule = massProperties(Geometry(Capsule{0.0f, 0.3f}), 10.0f);
  EXPECT_NEAR(capsule.mass, ball.mass, 1e-6f);
  EXPECT_NEAR((capsule.inertia - ball.inertia).norm(), 0.0f, 1e-6f);
  const MassProperties c = massProperties(Geometry(Cylinder{0.5f, 0.2f}), 10.0f);
  EXPECT_NEAR(c.inertia(0, 0), 0.5f * c.mass * 0.04f, 1e-6f);
  EXPECT_NEAR(c.inertia(1, 1), c.mass * (0.04f / 4.0f + 1.0f / 12.0f), 1e-6f);
}

TEST(MassProperties, BoxOf512SubBoxesEqualsTheBox) {
  std::vector<Shape> parts;
  const Quat turn(Eigen::AngleAxisf(0.7f, Vec3(1, 2, 3).normalized()));
  const Vec3 shift(3.0f, -2.0f, 1.0f);
  for (int i = 0; i < 512; ++i) {
    const Vec3 cell(float(i % 8) - 3.5f, float(i / 8 % 8) - 3.5f, float(i / 64) - 3.5f);
    parts.push_back({Box{Vec3(0.125f, 0.0625f, 0.25f)},
                     {shift + turn * cell.cwiseProduct(Vec3(0.25f, 0.125f, 0.5f)), turn}});
  }
  const MassProperties sum = massProperties(parts, 2.0f);
  const MassProperties whole = massProperties(Shape{Box{Vec3(1.0f, 0.5f, 2.0f)}, {shift, turn}}, 2.0f);
  EXPECT_NEAR(sum.mass, whole.mass, 1e-5f * whole.mass);
  EXPECT_NEAR((sum.center - shift).norm(), 0.0f, 1e-5f);
  EXPECT_LT((sum.inertia - whole.inertia).norm(), 1e-5f * whole.inertia.norm());
}

TEST(MassProperties, TwoBallsFollowTheParallelAxisTheorem) {
  const std::vector<Shape> balls{{Sphere{0.1f}, {Vec3(1, 0, 0), Quat::Identity()}},
                                 {Sphere{0.1f}, {Vec3(3, 0, 0), Quat::Identity()}}};
  const MassProperties one = massProperties(balls[0], 5.0f), two = massProperties(balls, 5.0f);
  EXPECT_NEAR(two.center.x(), 2.0f, 1e-6f);
  EXPECT_NEAR(two.inertia(0, 0), 2.0f * one.inertia(0, 0), 1e-6f);
  EXPECT_NEAR(two.inertia(1, 1), 2.0f * (one.inertia(1, 1) + one.mass), 1e-5f);
}

TEST(MassProperties, ScalingToAMassScalesInertiaAndRefusesNonsense) {
  const MassProperties m = massProperties(Geometry(Box{Vec3(1, 1, 1)}), 1.0f);
  const auto scaled = scaledToMass(m, 16.0f);
  ASSERT_TRUE(scaled.has_value());
  EXPECT_NEAR(scaled->inertia(0, 0), 2.0f * m.inertia(0, 0), 1e-5f);
  EXPECT_FALSE(scaledToMass(m, 0.0f).has_value());
  EXPECT_FALSE(scaledToMass(m, std::numeric_limits<float>::quiet_NaN()).has_value());
  EXPECT_FALSE(scaledToMass(massProperties(Geometry(Sphere{0.0f}), 1.0f), 1.0f).has_value());
}

}  // namespace
}  // namespace pfx
