// Coordinates of joints: known poses, and rates against finite differences.
#include "pfx/base_level/joint/joint_coordinates.h"

#include <gtest/gtest.h>

#include <random>

#include "pfx/base_level/joint/distance_joint.h"
#include "pfx/base_level/joint/gear_angles.h"
#include "pfx/base_level/joint/gear_joint.h"
#include "pfx/base_level/joint/hinge_joint.h"
#include "pfx/base_level/joint/slider_joint.h"
#include "pfx/base_level/joint/swing_twist_joint.h"
#include "pfx/base_level/joint/universal_joint.h"

namespace pfx {
namespace {

struct TwoBodies {
  RigidState a, b;
  TwoBodies() { b.position = Vec3(0, 0, 2); }
};

Quatd turn(double angle, const Vec3d& axis) { return Quatd(Eigen::AngleAxisd(angle, axis.normalized())); }

TEST(JointCoordinates, areZeroWhereTheJointWasMade) {
  const TwoBodies s;
  const Joint j = makeUniversalJoint(s.a, s.b, {.anchor_point = Vec3(0.1f, 0.2f, 1), .axis = Vec3(1, 2, 3)});
  const JointCoordinates c = measureJoint(j, toDouble(s.a.pose()), toDouble(s.b.pose()));
  for (const double x : c.value) EXPECT_NEAR(x, 0.0, 1e-6);  // the frames are stored as floats
}

TEST(JointCoordinates, countAHingeAngleAboutItsAxis) {
  TwoBodies s;
  const Joint j = makeHingeJoint(s.a, s.b, {.axis = Vec3::UnitY(), .lower_angle = -1, .upper_angle = 1});
  for (const double angle : {-3.0, -0.5, 0.0, 0.2, 1.5, 3.0}) {
    const TransformDouble b{s.b.position.cast<double>(), turn(angle, Vec3d::UnitY())};
    EXPECT_NEAR(measureJoint(j, toDouble(s.a.pose()), b).value[3], angle, 1e-6);
  }
}

TEST(JointCoordinates, measureASliderAlongItsDirection) {
  TwoBodies s;
  const Joint j = makeSliderJoint(s.a, s.b, {.anchor_point = Vec3(0, 0, 1), .direction = Vec3(0, 0, 2)});
  s.b.position += Vec3(0, 0, 0.75f);
  EXPECT_NEAR(measureJoint(j, toDouble(s.a.pose()), toDouble(s.b.pose())).value[0], 0.75, 1e-6);
}

TEST(JointCoordinates, coneAngleDoesNotDependOnItsDirection) {
  const TwoBodies s;
  const Joint j = makeSwingTwistJoint(s.a, s.b, {.twist_axis = Vec3::UnitX()});
  for (const double direction : {0.0, 1.0, 2.5, -2.0}) {
    const Vec3d axis(0.0, std::cos(direction), std::sin(direction));
    const TransformDouble b{s.b.position.cast<double>(), turn(0.6, axis) * turn(0.3, Vec3d::UnitX())};
    const JointCoordinates c = measureJoint(j, toDouble(s.a.pose()), b);
    EXPECT_NEAR(c.value[3], 0.3, 1e-6);
    EXPECT_NEAR(c.value[4], 0.6, 1e-6);
  }
}

TEST(JointCoordinates, gearsCountWholeTurns) {
  const TwoBodies s;
  Joint j = makeGearJoint(s.a, s.b, {.axis_a = -Vec3::UnitX(), .axis_b = Vec3::UnitZ(), .ratio = 2.0f});
  for (int i = 1; i <= 40; ++i) {
    const TransformDouble a{Vec3d::Zero(), turn(0.3 * i, -Vec3d::UnitX())},
        b{Vec3d::Zero(), turn(-0.6 * i, Vec3d::UnitZ())};
    const GearAngles angles = gearAngles(j, a, b);
    EXPECT_NEAR(angles.a, 0.3 * i, 1e-5);
    EXPECT_NEAR(angles.b, -0.6 * i, 1e-5);
    EXPECT_NEAR(measureJoint(j, a, b).value[3], 0.0, 1e-5);
    j.gear_angle_a = static_cast<float>(angles.a), j.gear_angle_b = static_cast<float>(angles.b);
  }
}

TEST(JointCoordinates, gearsCountAnyNumberOfTurnsAtOnce) {
  const TwoBodies s;
  const Joint j = makeGearJoint(s.a, s.b, {.axis_a = Vec3::UnitX(), .axis_b = Vec3::UnitZ(), .ratio = 2.0f});
  const TransformDouble a{Vec3d::Zero(), turn(20.0, Vec3d::UnitX())}, b{Vec3d::Zero(), turn(-40.0, Vec3d::UnitZ())};
  const GearAngles angles = gearAnglesNear(j, a, b, {17.5, -42.5});
  EXPECT_NEAR(angles.a, 20.0, 1e-5);
  EXPECT_NEAR(angles.b, -40.0, 1e-5);
  EXPECT_NEAR(gearCoordinate(j, angles), 0.0, 1e-5);
  const GearAngles rates = gearRates(j, a, Vec3d(3, 1, 0), b, Vec3d(1, 0, -6));
  EXPECT_NEAR(rates.a, 3.0, 1e-6);
  EXPECT_NEAR(rates.b, -6.0, 1e-6);
}

// Central differences over 1e-5 of a random motion: error 1e-10 from the step, 1e-10 from rounding.
void expectExactRates(const Joint& j, const TransformDouble& a, const TransformDouble& b, double tolerance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const JointLinearization l = linearizeJoint(j, a, b);
  for (int trial = 0; trial < 8; ++trial) {
    double u[12];
    for (double& x : u) x = number(random);
    const auto moved = [&](const TransformDouble& t, const double* v, double h) {
      const Vec3d w(v[3], v[4], v[5]);
      return TransformDouble{t.position + h * Vec3d(v[0], v[1], v[2]), turn(h * w.norm(), w) * t.orientation};
    };
    const double h = 1e-5;
    const JointCoordinates plus = measureJoint(j, moved(a, u, h), moved(b, u + 6, h));
    const JointCoordinates minus = measureJoint(j, moved(a, u, -h), moved(b, u + 6, -h));
    for (int axis = 0; axis < kNumJointAxes; ++axis) {
      if (!isConstrained(j.axis[axis])) continue;
      double rate = 0.0;
      for (int i = 0; i < 6; ++i) rate += l.jacobian.a[axis][i] * u[i] + l.jacobian.b[axis][i] * u[6 + i];
      EXPECT_NEAR((plus.value[axis] - minus.value[axis]) / (2 * h), rate, tolerance) << "axis " << axis;
    }
  }
}

TEST(JointCoordinates, ratesAgreeWithFiniteDifferences) {
  TwoBodies s;
  s.a.orientation = Quat(Eigen::AngleAxisf(0.4f, Vec3(1, 1, 0).normalized()));
  s.b.orientation = Quat(Eigen::AngleAxisf(0.4f, Vec3(1, 1, 0).normalized()));
  const TransformDouble a = toDouble(s.a.pose()), b = toDouble(s.b.pose());
  TransformDouble off = b;  // anchors apart, turned about the hinge's or slider's axis
  off.position += Vec3d(0.1, 0.05, -0.2);
  expectExactRates(makeSliderJoint(s.a, s.b, {.direction = Vec3(1, 0, 1)}), a, off, 1e-6);
  expectExactRates(makeDistanceJoint(s.a, s.b, {.anchor_point_b = Vec3(0, 1, 2)}), a, off, 1e-6);
  expectExactRates(makeGearJoint(s.a, s.b, {.axis_a = Vec3::UnitX(), .axis_b = Vec3::UnitY(), .ratio = 3}), a,
                   b, 1e-6);
  off.orientation = turn(0.7, Vec3d(1, 0, 0)) * off.orientation;
  expectExactRates(makeHingeJoint(s.a, s.b, {.axis = Vec3::UnitX(), .lower_angle = -1, .upper_angle = 1}), a,
                   off, 1e-6);
  const TransformDouble swung{off.position, turn(0.8, Vec3d(0, 1, 2)) * off.orientation};
  expectExactRates(makeSwingTwistJoint(s.a, s.b, {.twist_axis = Vec3::UnitX()}), a, swung, 1e-6);
}

}  // namespace
}  // namespace pfx
