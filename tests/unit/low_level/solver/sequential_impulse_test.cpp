// Sequential impulses against closed forms: one contact point.
#include "pfx/low_level/solver/sequential_impulse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/impulse_body.h"

namespace pfx {
namespace {

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

TEST(SequentialImpulse, AShareOfTheOverlapBeyondTheSlopIsTakenBackSlowlyUpTo3mm) {
  BallOnFloor b;
  b.input.velocity.setZero(), b.input.distance = -0.011f;
  b.solve(1, 0.0f);
  for (int i = 0; i < 3; ++i) solvePush(b.pair, 0.0f, b.point);
  EXPECT_NEAR(b.ball.push_v[1] * b.input.time_step, 0.2f * (0.008f + 0.03f * 0.002f), 1e-7f);
  EXPECT_EQ(b.ball.dv[1], 0.0f);  // nothing of it stays
}

TEST(SequentialImpulse, APushMovesNothingSidewaysThatFrictionHolds) {
  BallOnFloor b;
  b.input.velocity = {0, -0.3f, 0}, b.input.distance = -0.02f;
  b.solve(1, 0.5f);
  b.ball.push_v[0] = 0.01f;  // by another contact
  for (int i = 0; i < 20; ++i) solvePush(b.pair, 0.5f, b.point);
  const Vec3 arm(0, -0.5f, 0);
  EXPECT_NEAR(b.ball.push_v[0] + Vec3::Map(b.ball.push_w).cross(arm).x(), 0.0f, 1e-6f);
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

}  // namespace
}  // namespace pfx
