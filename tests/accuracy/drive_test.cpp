// ACC-10: motors, springs and limits of a hinge against closed forms, at 60 Hz and 4 sub-steps.
#include <gtest/gtest.h>

#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

constexpr double kPivotInertia =
    1.0 / 3.0 + 0.01 / 12.0;  // kg m^2, of a 1 m, 1 kg, 0.1 m wide rod about its end

struct Arm {
  World world;
  BodyId rod;
  JointId hinge;
  AxisConstraint& axis() { return world.joint(hinge).axis[3]; }
  double angle() const { return angleAboutZ(world.states()[rod.index]); }
  double speed() const { return world.states()[rod.index].angular_velocity.z(); }
};

Arm makeArm(double angle, bool gravity) {
  WorldDef def = worldDef(4);
  if (!gravity) def.gravity = Vec3::Zero();
  Arm a{World(def), {}, {}};
  const BodyId post = addPost(a.world);
  a.rod = addRod(a.world, {}, downAt(angle, 0.5), angle);
  a.hinge =
      a.world.addJoint({.body_a = post, .body_b = a.rod, .params = HingeJointParams{.axis = Vec3::UnitZ()}});
  return a;
}

TEST(AccDrive, aMotorAcceleratesUpToItsSpeed) {
  Arm a = makeArm(0.0, false);
  a.axis().motor_speed = 10.0f;
  a.axis().motor_max_force = 2.0f;
  Worst error;
  for (int i = 1; i <= 180; ++i) {
    a.world.step(kDt);
    error.add((a.speed() - std::min(2.0 / kPivotInertia * i * static_cast<double>(kDt), 10.0)) / 10.0);
  }
  report("motor, speed, relative", error.value, 1e-3, "");
  EXPECT_LT(std::abs(error.value), 1e-3);
}

// Whether the arm is still horizontal after two seconds.
bool holds(float torque) {
  Arm a = makeArm(M_PI / 2, true);
  a.axis().motor_max_force = torque;
  for (int i = 0; i < 120; ++i) a.world.step(kDt);
  return std::abs(a.angle() - M_PI / 2) < 1e-2;
}

TEST(AccDrive, aMotorHoldsTheArmFromTheRightTorqueOn) {
  float low = 4.0f, high = 6.0f;
  for (int i = 0; i < 12; ++i) {
    const float middle = 0.5f * (low + high);
    (holds(middle) ? high : low) = middle;
  }
  const double error = high / (kGravity * 0.5) - 1.0;
  report("motor, holding torque, relative", error, 5e-3, "");
  EXPECT_LT(std::abs(error), 5e-3);
}

TEST(AccDrive, aSpringHasItsFrequencyAndDamping) {
  Arm a = makeArm(0.3, false);
  a.axis().spring_frequency = 1.0f;
  a.axis().spring_damping = 0.1f;
  a.axis().spring_target = -0.3f;  // the joint's zero is where it was made
  const double w = 2.0 * M_PI, damped = w * std::sqrt(1.0 - 0.01);
  Worst error;
  for (int i = 1; i <= 180; ++i) {
    a.world.step(kDt);
    const double t = i * static_cast<double>(kDt);
    const double x =
        0.3 * std::exp(-0.1 * w * t) * (std::cos(damped * t) + 0.1 * w / damped * std::sin(damped * t));
    error.add((a.angle() - x) / 0.3);
  }
  report("spring, 3 s, relative to the amplitude", error.value, 1e-3, "");
  EXPECT_LT(std::abs(error.value), 1e-3);
}

TEST(AccDrive, aLimitStopsTheArmWithoutOvershoot) {
  Arm a = makeArm(0.5, false);
  AxisConstraint& axis = a.axis();
  axis.lock = JointLock::Limit;
  axis.lower = -0.5f;
  axis.upper = 1.0f;
  a.world.state(a.rod).angular_velocity = Vec3(0, 0, -4);
  a.world.state(a.rod).linear_velocity = Vec3(0, 0, -4).cross(a.world.states()[a.rod.index].position);
  double lowest = 1.0, impulse = 0.0;
  for (int i = 0; i < 30; ++i) {
    a.world.step(kDt);
    lowest = std::min(lowest, a.angle());
    impulse += a.world.joints()[a.hinge.index].torque.z() * static_cast<double>(kDt);
  }
  report("limit, overshoot", -lowest, 1e-3, "rad");
  report("limit, impulse over I w", impulse / (kPivotInertia * 4.0) - 1.0, 1e-3, "");
  EXPECT_GT(lowest, -1e-3);
  EXPECT_NEAR(a.speed(), 0.0, 1e-3);
  EXPECT_NEAR(impulse / (kPivotInertia * 4.0), 1.0, 1e-3);
}

}  // namespace
}  // namespace pfx_test
