// Characters on the ground: speeds, slopes, steps, jumps, crouching.
#include "tests/unit/high_level/character/course.h"

namespace {

using namespace pfx;
using S = CharacterState;

const Vec3 kAhead(0.0f, 0.0f, 1.0f);

TEST(CharacterOnGround, StandsStill) {
  Course c;
  c.add(Vec3(1.0f, 0.0f, 2.0f));
  c.run(5.0f);
  EXPECT_EQ(c.state(), S::Stand);
  EXPECT_LT((c.feet() - Vec3(1.0f, 0.0f, 2.0f)).norm(), 0.002f);
  EXPECT_LT(c.body().orientation.vec().norm(), 1e-6f);
}

TEST(CharacterOnGround, WalksAndRunsAtItsSpeeds) {
  Course c;
  c.add(Vec3::Zero());
  for (const bool run : {false, true}) {
    c.inputs[0] = {.direction = kAhead, .run = run};
    c.run(1.0f);
    const float from = c.feet().z();
    c.run(2.0f);
    EXPECT_EQ(c.state(), run ? S::Run : S::Walk);
    EXPECT_NEAR((c.feet().z() - from) / 2.0f, run ? 4.5f : 1.6f, 0.005f);
    EXPECT_NEAR(c.feet().y(), 0.0f, 0.002f);
  }
  c.inputs[0] = {};
  c.run(1.0f);
  EXPECT_EQ(c.state(), S::Stand);
  EXPECT_LT(c.body().linear_velocity.norm(), 1e-3f);
}

TEST(CharacterOnGround, LegsSpeedItUpByTheirForceAndNoFaster) {
  Course c;
  c.add(Vec3::Zero());
  c.run(0.2f);
  c.inputs[0] = {.direction = kAhead, .run = true};
  float last = 0.0f, most = 0.0f;
  for (int i = 0; i < 60; ++i) {
    c.step();
    most = std::max(most, (c.body().linear_velocity.z() - last) / kDt);
    last = c.body().linear_velocity.z();
  }
  EXPECT_NEAR(most, 800.0f / 80.0f, 0.05f);
}

TEST(CharacterOnGround, TurnsTowardsWhereItGoes) {
  Course c;
  c.add(Vec3::Zero());
  c.inputs[0] = {.direction = Vec3(1.0f, 0.0f, 0.0f)};
  c.run(1.0f);
  EXPECT_LT((facingOf(c.characters[0]) - Vec3::UnitX()).norm(), 1e-5f);
  EXPECT_LT((c.body().orientation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-5f);
}

// The speed along the surface, up and down.
TEST(CharacterOnGround, KeepsItsSpeedOnSlopes) {
  for (const float angle : {0.2f, 0.5f, 0.8f}) {
    Course c;
    addSlope(c, angle, 1.0f);
    c.add(Vec3(0.0f, 0.0f, -0.5f));
    for (const float sign : {1.0f, -1.0f}) {
      c.inputs[0] = {.direction = sign * kAhead};
      c.run(sign > 0.0f ? 3.0f : 0.5f);
      const Vec3 from = c.feet();
      c.run(1.0f);
      EXPECT_EQ(c.state(), S::Walk) << angle;
      EXPECT_NEAR((c.feet() - from).norm(), 1.6f, 0.01f) << angle << ", " << sign;
      EXPECT_NEAR((c.feet() - from).y() / (c.feet() - from).z(), std::tan(angle), 0.01f)
          << angle << ", " << sign;
    }
    c.inputs[0] = {};
    c.run(0.5f);
    const Vec3 at = c.feet();
    c.run(3.0f);
    EXPECT_LT((c.feet() - at).norm(), 0.001f) << "stands on the slope";
  }
}

TEST(CharacterOnGround, RefusesASlopeOfSixtyDegrees) {
  for (const bool run : {false, true}) {
    Course c;
    addSlope(c, 1.0471976f, 2.0f);
    c.add(Vec3::Zero());
    c.inputs[0] = {.direction = kAhead, .run = run};
    float highest = 0.0f;
    for (int i = 0; i < 300; ++i) c.step(), highest = std::max(highest, c.feet().y());
    EXPECT_LT(highest, 0.01f);
    // The round end touches the slope where its tangent point says: r tan(30 degrees) before its foot.
    EXPECT_NEAR(c.feet().z(), 2.0f - 0.3f * std::tan(0.5f * 1.0471976f), 0.02f);
    // Along it, it slides on.
    c.inputs[0].direction = Vec3(0.70710678f, 0.0f, 0.70710678f);
    const float x = c.feet().x();
    c.run(1.0f);
    EXPECT_GT(c.feet().x() - x, run ? 2.0f : 0.7f);
    EXPECT_LT(c.feet().y(), 0.01f);
  }
}

TEST(CharacterOnGround, SlidesDownASlopeOfSixtyDegrees) {
  Course c;
  addSlope(c, 1.0471976f, 0.0f);
  c.add(Vec3(0.0f, 5.5f, 3.0f));
  float most = 0.0f;
  for (int i = 0; i < 40; ++i) {
    c.inputs[0] = {.direction = kAhead};
    c.step();
    if (c.state() == S::Slide) most = std::max(most, c.body().linear_velocity.y());
  }
  EXPECT_TRUE(c.seen.contains(S::Slide));
  EXPECT_LE(most, 0.0f) << "it never climbs";
  c.run(4.0f);
  EXPECT_EQ(c.state(), S::Walk);
  EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
}

class Steps : public testing::TestWithParam<float> {};

TEST_P(Steps, AreClimbedUpToTheStepHeightUpAndDown) {
  const float height = GetParam();
  Course c;
  addStairs(c, 6, height, 0.35f);
  c.add(Vec3(0.0f, 0.0f, 0.5f));
  c.inputs[0] = {.direction = kAhead};
  const float top = 6.0f * height;
  float highest = 0.0f;
  for (int i = 0; i < 480 && c.feet().z() < 5.5f; ++i) c.step(), highest = std::max(highest, c.feet().y());
  EXPECT_NEAR(c.feet().y(), top, 0.005f);
  EXPECT_LT(highest, top + 0.02f) << "no hop";
  // The round end of the capsule meets a low edge like a slope that it can walk on.
  EXPECT_EQ(c.seen.contains(S::Climb), height > 0.15f);
  EXPECT_FALSE(c.seen.contains(S::Fall));
  c.inputs[0] = {.direction = -kAhead};
  for (int i = 0; i < 480 && c.feet().z() > 0.5f; ++i) c.step();
  EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
  EXPECT_FALSE(c.seen.contains(S::Fall)) << "it keeps its feet on the steps";
}

INSTANTIATE_TEST_SUITE_P(Heights, Steps, testing::Values(0.1f, 0.2f, 0.3f), [](const auto& p) {
  return std::to_string(static_cast<int>(100.0f * p.param + 0.5f)) + "cm";
});

TEST(CharacterOnGround, RefusesAStepThatIsTooHigh) {
  for (const float height : {0.32f, 0.4f, 1.0f, 3.0f}) {
    Course c;
    addStairs(c, 1, height, 0.5f);
    c.add(Vec3::Zero());
    c.inputs[0] = {.direction = kAhead, .run = true};
    float highest = 0.0f;
    for (int i = 0; i < 240; ++i) c.step(), highest = std::max(highest, c.feet().y());
    EXPECT_LT(highest, 0.01f) << height;
    EXPECT_NEAR(c.feet().z(), 2.0f - (height < 0.3f ? 0.0f : 0.3f), 0.01f) << height;
  }
}

TEST(CharacterOnGround, TakesNoStepUnderALowCeiling) {
  Course c;
  addStairs(c, 1, 0.25f, 0.5f);
  c.addBox(Vec3(0.0f, 3.0f, 5.0f), Vec3(5.0f, 1.05f, 5.0f), MotionType::Fixed);  // 1.95 m above the ground
  c.add(Vec3::Zero());
  c.inputs[0] = {.direction = kAhead};
  c.run(3.0f);
  EXPECT_LT(c.feet().y(), 0.01f);
  EXPECT_LT(c.feet().z(), 1.8f);
}

TEST(CharacterOnGround, JumpsAsHighAsItsSpeedSays) {
  for (const bool run : {false, true}) {
    Course c;
    c.add(Vec3::Zero());
    c.inputs[0] = {.direction = run ? kAhead : Vec3(Vec3::Zero()), .run = run};
    c.run(1.0f);
    const float ground = c.feet().y();
    c.inputs[0].jump = true;
    float highest = 0.0f, speed = 0.0f;
    c.step();
    EXPECT_EQ(c.state(), S::Jump);
    speed = c.characters[0].decision.velocity.y();
    for (int i = 0; i < 90; ++i) c.step(), highest = std::max(highest, c.feet().y() - ground);
    // What a sampled top may miss: g (dt / 2)^2 / 2 = 0.34 mm; the step of the take-off as much again.
    EXPECT_NEAR(highest, speed * speed / (2.0f * kGravity), 0.001f);
    EXPECT_NEAR(highest, 0.8f, 0.001f);
    EXPECT_EQ(c.state(), run ? S::Run : S::Stand) << "one jump for one press";
    EXPECT_TRUE(c.seen.contains(S::Fall));
    EXPECT_TRUE(c.seen.contains(S::Land));
    EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
  }
}

TEST(CharacterOnGround, FallsOffALedgeAndTakesTheLandingUp) {
  Course c;
  c.addBox(Vec3(0.0f, 1.0f, 0.0f), Vec3(1.0f, 1.0f, 1.0f), MotionType::Fixed);
  c.add(Vec3(0.0f, 2.0f, 0.0f));
  c.inputs[0] = {.direction = kAhead};
  float fastest = 0.0f, recovery = 0.0f, expected = 0.0f;
  for (int i = 0; i < 240; ++i) {
    c.step();
    // From where it lost its hold: v^2 = v0^2 + 2 g h.
    const float v = c.body().linear_velocity.y();
    if (c.state() == S::Fall && expected == 0.0f)
      expected = std::sqrt(v * v + 2.0f * kGravity * c.feet().y());
    fastest = std::max(fastest, -c.body().linear_velocity.y());
    if (c.state() == S::Land) recovery += kDt;
  }
  EXPECT_TRUE(c.seen.contains(S::Fall));
  EXPECT_GT(expected, 5.5f);
  EXPECT_NEAR(fastest, expected, kGravity * kDt) << "sampled once a step";
  EXPECT_NEAR(recovery, 0.05f * fastest, 2.0f * kDt);
  EXPECT_EQ(c.state(), S::Walk);
  EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
}

TEST(CharacterOnGround, CrouchesUnderABeamAndStandsUpBehindIt) {
  Course c;
  c.addBox(Vec3(0.0f, 2.2f, 3.0f), Vec3(3.0f, 1.0f, 1.0f), MotionType::Fixed);  // 1.2 m above the ground
  c.add(Vec3::Zero());
  c.inputs[0] = {.direction = kAhead};
  c.run(3.0f);
  EXPECT_NEAR(c.feet().z(), 1.7f, 0.01f) << "upright it does not fit";
  c.inputs[0].crouch = true;
  c.run(2.0f);
  EXPECT_EQ(c.state(), S::Sneak);
  EXPECT_GT(c.feet().z(), 2.2f);
  const float from = c.feet().z();
  c.run(0.5f);
  EXPECT_NEAR((c.feet().z() - from) / 0.5f, 0.8f, 0.01f);
  c.inputs[0] = {};
  c.run(0.5f);
  EXPECT_EQ(c.state(), S::Crouch) << "no headroom";
  EXPECT_NEAR(c.characters[0].height(), 1.1f, 1e-6f);
  c.inputs[0] = {.direction = kAhead};
  c.run(2.5f);
  EXPECT_EQ(c.state(), S::Walk);
  EXPECT_NEAR(c.characters[0].height(), 1.8f, 1e-6f);
  EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
}

TEST(CharacterOnGround, GoesAlongAWallThatItMeetsAskew) {
  Course c;
  c.addBox(Vec3(0.0f, 2.0f, 3.0f), Vec3(30.0f, 2.0f, 1.0f), MotionType::Fixed);
  c.add(Vec3(0.0f, 0.0f, 1.0f));
  c.inputs[0] = {.direction = Vec3(0.6f, 0.0f, 0.8f)};
  c.run(2.0f);
  const Vec3 from = c.feet();
  c.run(1.0f);
  EXPECT_NEAR(c.feet().z(), 1.7f, 0.005f);
  EXPECT_NEAR(c.feet().x() - from.x(), 0.6f * 1.6f, 0.35f);
  EXPECT_GT(c.feet().x() - from.x(), 0.9f);
}

}  // namespace
