// Sequential impulses against closed forms: one contact point, one row of a joint.
#include "pfx/low_level/solver/sequential_impulse.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfx {
namespace {

ImpulseBody massive(float mass, float inertia) {
  ImpulseBody body = {};
  body.inv_mass = 1.0f / mass;
  for (int k = 0; k < 3; ++k) body.inv_inertia[4 * k] = 1.0f / inertia;
  return body;
}

// A ball of 2 kg on a floor that does not move, touching at its lowest point.
struct BallOnFloor {
  ImpulseBody ball = massive(2.0f, 0.5f), floor = {};
  ImpulsePair pair{ball, floor};
  ImpulsePoint point = {};
  ImpulseContactInput input{.arm_a = {0, -0.5f, 0},
                            .arm_b = {0, 1, 0},
                            .velocity = {0, -0.3f, 0},
                            .normal = {0, 1, 0},
                            .distance = 0.0f,
                            .restitution = 0.0f,
                            .separate_bias = 0.2f,
                            .time_step = 0.01f};

  void solve(int iterations, float friction) {
    setupImpulsePoint(input, pair, point);
    warmStart(pair, point);
    for (int i = 0; i < iterations; ++i) solveImpulses(pair, friction, point);
  }
};

TEST(SequentialImpulse, ABlowIsStoppedByItsMomentum) {
  BallOnFloor b;
  b.solve(1, 0.0f);
  EXPECT_FLOAT_EQ(b.point.rows[0].impulse, 2.0f * 0.3f);
  EXPECT_FLOAT_EQ(b.ball.dv[1], 0.3f);
  EXPECT_EQ(b.floor.dv[1], 0.0f);
}

TEST(SequentialImpulse, AFastBlowBouncesByItsRestitution) {
  BallOnFloor b;
  b.input.velocity = {0, -4, 0}, b.input.restitution = 0.25f;
  b.solve(1, 0.0f);
  EXPECT_FLOAT_EQ(b.ball.dv[1], 4.0f + 1.0f);
}

TEST(SequentialImpulse, AGapMayCloseWithinTheStepAndNoMore) {
  BallOnFloor b;
  b.input.distance = 0.001f;
  b.solve(1, 0.0f);
  EXPECT_NEAR((b.input.velocity.y() + b.ball.dv[1]) * b.input.time_step, -0.001f, 1e-7f);
  BallOnFloor far;
  far.input.distance = 0.004f;  // 3 mm in the step do not reach the floor
  far.solve(1, 0.0f);
  EXPECT_EQ(far.point.rows[0].impulse, 0.0f);
}

TEST(SequentialImpulse, AShareOfTheOverlapBeyondTheSlopIsTakenBack) {
  BallOnFloor b;
  b.input.velocity.setZero(), b.input.distance = -0.011f;
  b.solve(1, 0.0f);
  EXPECT_NEAR(b.ball.dv[1] * b.input.time_step, 0.2f * (0.011f - 0.001f), 1e-7f);
}

TEST(SequentialImpulse, FrictionStaysInTheConeAndStopsWhatItCan) {
  for (const float friction : {0.1f, 10.0f}) {
    BallOnFloor b;
    b.input.velocity = {0.6f, -0.3f, 0.8f};  // slips by 1 m/s
    b.solve(1, friction);
    const Vec2 tangential(b.point.rows[1].impulse, b.point.rows[2].impulse);
    // The point of the ball weighs 1 / (1 / m + r^2 / I) = 1 kg against a push sideways.
    EXPECT_NEAR(tangential.norm(), std::min(friction * 0.6f, 1.0f), 1e-6f);
    EXPECT_NEAR(b.ball.dv[0] / b.ball.dv[2], 0.75f, 1e-5f);  // against the slip, whatever the tangents are
  }
}

TEST(SequentialImpulse, TheImpulsesOfTheLastStepAreASolutionOfTheSameOne) {
  BallOnFloor b;
  b.input.velocity = {0.3f, -0.3f, 0.0f};
  b.solve(20, 0.5f);
  const ImpulsePoint before = b.point;
  b.ball = massive(2.0f, 0.5f);
  b.solve(1, 0.5f);
  for (int r = 0; r < 3; ++r) EXPECT_NEAR(b.point.rows[r].impulse, before.rows[r].impulse, 1e-6f) << r;
}

TEST(SequentialImpulse, TwoBodiesShareMomentum) {
  ImpulseBody a = massive(1.0f, 1.0f), b = massive(3.0f, 1.0f);
  ImpulsePoint point = {};
  const ImpulsePair pair{a, b};
  setupImpulsePoint({{-1, 0, 0}, {1, 0, 0}, {-2, 0, 0}, {1, 0, 0}, 0.0f, 0.0f, 0.2f, 0.01f}, pair, point);
  for (int i = 0; i < 3; ++i) solveImpulses(pair, 0.6f, point);
  EXPECT_NEAR(a.dv[0] + 3.0f * b.dv[0], 0.0f, 1e-6f);
  EXPECT_NEAR(-2.0f + a.dv[0] - b.dv[0], 0.0f, 1e-6f);
}

// A row that moves body B along x, at a value of `value` and a rate of `rate`.
struct SlidingAxis {
  ImpulseBody a = {}, b = massive(2.0f, 1.0f);
  ImpulsePair pair{a, b};
  AxisConstraint axis;
  ImpulseJointRow row = {};

  float impulse(double value, float rate) {
    const double jacobian_a[6] = {-1, 0, 0, 0, 0, 0}, jacobian_b[6] = {1, 0, 0, 0, 0, 0};
    row = {}, b = massive(2.0f, 1.0f);
    setupImpulseJointRow({axis, value, jacobian_a, jacobian_b, rate, 0.01f, false}, pair, row);
    solveImpulses(pair, row);
    return row.impulse;
  }
};

TEST(SequentialImpulse, AJointRowIsWeightTimesPositionAndVelocityError) {
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

TEST(SequentialImpulse, ALimitPullsBackFromOutsideAndLeavesAloneInside) {
  SlidingAxis s;
  s.axis.lock = JointLock::Limit;
  s.axis.lower = -1.0f, s.axis.upper = 1.0f, s.axis.bias = 0.2f;
  EXPECT_EQ(s.impulse(0.5, 3.0f), 0.0f);
  EXPECT_NEAR(s.impulse(1.05, 0.4f), 2.0f * (-0.2f * 0.05f / 0.01f - 0.4f), 1e-5f);
  EXPECT_EQ(s.impulse(1.05, -5.0f), 0.0f);  // on its way back already
  EXPECT_NEAR(s.impulse(0.99, 3.0f), 2.0f * (1.0f - 3.0f), 1e-4f);  // may come as far as the limit within the step
  s.axis.damping = 0.25f;
  EXPECT_NEAR(s.impulse(0.0, 3.0f), -0.25f * 2.0f * 3.0f, 1e-5f);
}

}  // namespace
}  // namespace pfx
