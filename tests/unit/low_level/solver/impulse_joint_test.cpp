// Joints in sequential impulses: one row against its closed form, six against the conditions of the bounded problem.
#include "pfx/low_level/solver/impulse_joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/impulse_body.h"

namespace pfx {
namespace {

struct SixRows {
  ImpulseJointRow row[kNumJointAxes] = {};
  double coupling[kNumImpulseCouplings] = {};
  ImpulseJoint joint{{&row[0], &row[1], &row[2], &row[3], &row[4], &row[5]}, coupling};
};

// An axis that moves body B along x, at a value of `value` and a rate of `rate`.
struct SlidingAxis {
  ImpulseBody a = {}, b = massive(2.0f, 1.0f);
  ImpulsePair pair{a, b};
  AxisConstraint axis;

  float impulse(double value, float rate) {
    const double jacobian_a[6] = {-1, 0, 0, 0, 0, 0}, jacobian_b[6] = {1, 0, 0, 0, 0, 0};
    SixRows rows;
    b = massive(2.0f, 1.0f);
    setupImpulseJointRow({axis, value, jacobian_a, jacobian_b, rate, 0.01f, false}, pair, rows.row[0]);
    coupleImpulseRows(pair, rows.joint);
    solveImpulses(pair, rows.joint);
    return rows.row[0].impulse;
  }
};

TEST(ImpulseJoint, ARowIsWeightTimesPositionAndVelocityError) {
  SlidingAxis s;
  s.axis.lock = JointLock::Fixed;
  for (const float bias : {0.0f, 0.2f, 1.0f})
    for (const float weight : {0.0f, 0.5f, 1.0f}) {
      s.axis.bias = bias, s.axis.weight = weight;
      EXPECT_NEAR(s.impulse(0.03, 0.4f), weight * 2.0f * (-bias * 0.03f / 0.01f - 0.4f), 1e-5f) << bias << " " << weight;
    }
  s.axis.bias = 1.0f, s.axis.weight = 1.0f, s.axis.max_force = 0.5f;
  EXPECT_EQ(s.impulse(1.0, 0.0f), -0.5f);
}

TEST(ImpulseJoint, ALimitPullsBackFromOutsideAndLeavesAloneInside) {
  SlidingAxis s;
  s.axis.lock = JointLock::Limit;
  s.axis.lower = -1.0f, s.axis.upper = 1.0f, s.axis.bias = 0.2f;
  EXPECT_EQ(s.impulse(0.5, 3.0f), 0.0f);
  EXPECT_NEAR(s.impulse(1.05, 0.4f), 2.0f * (-0.2f * 0.05f / 0.01f - 0.4f), 1e-5f);
  EXPECT_EQ(s.impulse(1.05, -5.0f), 0.0f);  // on its way back already
  EXPECT_NEAR(s.impulse(0.99, 3.0f), 2.0f * (1.0f - 3.0f), 1e-4f);  // may come as far as the limit within the step
  EXPECT_NEAR(s.impulse(-0.99, -3.0f), 2.0f * (3.0f - 1.0f), 1e-4f);
  s.axis.damping = 0.25f;
  EXPECT_NEAR(s.impulse(0.0, 3.0f), -0.25f * 2.0f * 3.0f, 1e-5f);
}

TEST(ImpulseJoint, ARangeWithoutAnEndAsksForNothingBeyondIt) {
  SlidingAxis s;
  s.axis.lock = JointLock::Limit;
  s.axis.lower = -std::numeric_limits<float>::infinity(), s.axis.upper = 1.0f;
  EXPECT_EQ(s.impulse(-1e6, -3.0f), 0.0f);
  EXPECT_NEAR(s.impulse(0.99, 3.0f), 2.0f * (1.0f - 3.0f), 1e-4f);
  s.axis.upper = std::numeric_limits<float>::infinity();
  EXPECT_EQ(s.impulse(0.0, 3.0f), 0.0f);
}

// Two bodies of which one is much thinner than the levers are long, on six rows in any direction and with any bounds. After
// one iteration every row has its rate, or rests at a bound that keeps it from it.
TEST(ImpulseJoint, OneIterationSolvesTheRowsOfOneJoint) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(-1.0f, 1.0f);
  int at_bounds = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    ImpulseBody a = massive(1.0f, 0.4f), b = massive(2.0f, 0.01f);
    const ImpulsePair pair{a, b};
    SixRows rows;
    for (int i = 0; i < kNumJointAxes; ++i) {
      AxisConstraint axis;
      axis.lock = trial % 2 == 0 || i < 3 ? JointLock::Fixed : JointLock::Limit;
      axis.bias = 0.0f;
      axis.lower = -0.01f, axis.upper = 0.01f;
      if (trial % 3 == 0) axis.max_force = 0.2f;
      double jacobian_a[6], jacobian_b[6];
      const Vec3 n = i < 3 ? Vec3(Vec3::Unit(i)) : Vec3(Vec3::Zero()), w = Vec3::Unit(i % 3);
      const Vec3 lever(0.5f, 2.0f, -1.0f);
      const Vec3 turn_a = i < 3 ? Vec3(lever.cross(n)) : Vec3(-w), turn_b = i < 3 ? Vec3(-2.0f * lever.cross(n)) : w;
      for (int k = 0; k < 3; ++k) {
        jacobian_a[k] = -n[k], jacobian_a[3 + k] = turn_a[k];
        jacobian_b[k] = n[k], jacobian_b[3 + k] = turn_b[k];
      }
      setupImpulseJointRow({axis, axis.lower, jacobian_a, jacobian_b, number(random), 0.01f, false}, pair, rows.row[i]);
    }
    coupleImpulseRows(pair, rows.joint);
    solveImpulses(pair, rows.joint);
    for (const ImpulseJointRow& row : rows.row) {
      float rate = -row.rhs / row.inv_diag;
      const float* v[] = {a.dv, a.dw, b.dv, b.dw};
      for (int k = 0; k < 12; ++k) rate += row.jacobian[k] * v[k / 3][k % 3];
      const bool free = row.impulse > row.lower && row.impulse < row.upper;
      at_bounds += !free;
      if (free) EXPECT_NEAR(rate, 0.0f, 5e-4f) << trial;
      else if (row.impulse == row.lower) EXPECT_GT(rate, -5e-4f) << trial;
      else EXPECT_LT(rate, 5e-4f) << trial;
    }
  }
  EXPECT_GT(at_bounds, 500);
}

}  // namespace
}  // namespace pfx
