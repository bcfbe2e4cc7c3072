// Characters among bodies that move, and among each other.
#include "pfx/base_level/math/trig.h"
#include "tests/unit/high_level/character/course.h"

namespace {

using namespace pfx;
using S = CharacterState;

const Vec3 kAhead(0.0f, 0.0f, 1.0f);

// A platform that runs to and fro, goes up and down and turns, all at once.
TEST(CharacterAmongBodies, RidesAPlatformWithoutDrift) {
  Course c;
  const BodyId platform = c.addBox(Vec3(0.0f, 1.0f, 0.0f), Vec3(2.0f, 0.25f, 2.0f), MotionType::Keyframe);
  c.add(Vec3(0.8f, 1.25f, 0.5f));
  c.run(0.2f);
  const auto onPlatform = [&] { return c.world.states()[platform.index].pose().applyInverse(c.feet()); };
  const Vec3 start = onPlatform();
  float drift = 0.0f, t = 0.0f;
  for (int i = 0; i < 1200; ++i) {
    t += kDt;
    const Vec3 at(3.0f * sin(0.7f * t), 1.0f + 0.5f * sin(1.1f * t), 2.0f * sin(0.5f * t));
    c.world.moveKeyframe(platform, {at, expMap(0.5f * t * Vec3::UnitY())}, kDt);
    c.step();
    drift = std::max(drift, (onPlatform() - start).norm());
    ASSERT_EQ(c.state(), S::Stand) << i;
  }
  RecordProperty("drift_mm", std::to_string(1e3f * drift));
  EXPECT_LT(drift, 0.001f);
}

TEST(CharacterAmongBodies, LeavesAPlatformWithItsVelocity) {
  Course c;
  const BodyId platform = c.addBox(Vec3(0.0f, 0.25f, 0.0f), Vec3(2.0f, 0.25f, 2.0f), MotionType::Keyframe);
  c.add(Vec3(0.0f, 0.5f, 0.0f));
  for (int i = 0; i < 90; ++i) {
    c.world.moveKeyframe(platform, {Vec3(2.0f * kDt * static_cast<float>(i), 0.25f, 0.0f), Quat::Identity()},
                         kDt);
    c.inputs[0].jump = i > 60;
    c.step();
  }
  EXPECT_EQ(c.state(), S::Fall);
  EXPECT_NEAR(c.body().linear_velocity.x(), 2.0f, 0.01f);
}

TEST(CharacterAmongBodies, PushesAFiveKilogramBox) {
  Course c;
  const BodyId box = c.addBox(Vec3(0.0f, 0.4f, 1.5f), Vec3::Constant(0.4f), MotionType::Active, 5.0f);
  c.add(Vec3::Zero());
  c.inputs[0] = {.direction = kAhead};
  c.run(4.0f);
  EXPECT_EQ(c.state(), S::Push);
  EXPECT_GT(c.world.states()[box.index].position.z(), 4.0f);
  EXPECT_NEAR(c.world.states()[box.index].linear_velocity.z(), 1.6f, 0.2f);
}

// On ice the box takes up all that the legs give: F = (m + M) a.
TEST(CharacterAmongBodies, PushesWithTheForceOfItsLegsAndNoMore) {
  Course c;
  const float mass = 400.0f;
  const BodyId box = c.addBox(Vec3(0.0f, 0.5f, 0.85f), Vec3::Constant(0.5f), MotionType::Active, mass);
  c.world.body(box).friction = 0.0f;
  c.add(Vec3(0.0f, 0.0f, 0.04f));
  c.inputs[0] = {.direction = kAhead, .run = true};
  c.run(0.3f);
  const float from = c.world.states()[box.index].linear_velocity.z();
  c.run(0.3f);
  const float force = (mass + 80.0f) * (c.world.states()[box.index].linear_velocity.z() - from) / 0.3f;
  EXPECT_LT(force, 401.0f);
  EXPECT_GT(force, 380.0f);
}

TEST(CharacterAmongBodies, DoesNotMoveWhatFrictionHolds) {
  Course c;
  // 0.6 * 9.8 m/s^2 * 200 kg = 1176 N > 400 N
  const BodyId box = c.addBox(Vec3(0.0f, 0.5f, 1.5f), Vec3(0.8f, 0.5f, 0.8f), MotionType::Active, 200.0f);
  c.add(Vec3(0.0f, 0.0f, 0.0f));
  c.inputs[0] = {.direction = kAhead};
  c.run(1.5f);
  const float from = c.world.states()[box.index].position.z();
  c.run(3.0f);
  EXPECT_NEAR(c.world.states()[box.index].position.z(), from, 0.01f);
}

TEST(CharacterAmongBodies, IsPushedByAKeyFrameBar) {
  Course c;
  const BodyId bar = c.addBox(Vec3(-2.0f, 1.0f, 0.0f), Vec3(0.2f, 0.2f, 2.0f), MotionType::Keyframe);
  c.add(Vec3::Zero());
  for (int i = 0; i < 180; ++i) {
    c.world.moveKeyframe(
        bar, {Vec3(-2.0f + 1.5f * kDt * static_cast<float>(i + 1), 1.0f, 0.0f), Quat::Identity()}, kDt);
    c.step();
    const float overlap = c.world.states()[bar.index].position.x() + 0.2f - (c.feet().x() - 0.3f);
    ASSERT_LT(overlap, 0.01f) << "step " << i;
  }
  EXPECT_NEAR(c.feet().x(), -2.0f + 4.5f + 0.5f, 0.1f);
  EXPECT_NEAR(c.feet().y(), 0.0f, 0.005f);
  EXPECT_LT(c.body().orientation.vec().norm(), 1e-6f) << "it does not tip over";
}

TEST(CharacterAmongBodies, CarriesItsWeightOntoWhatItStandsOn) {
  Course c;
  // A seesaw: the far end rises when the character steps on the near one.
  const BodyId plank = c.addBox(Vec3(0.0f, 0.55f, 0.0f), Vec3(0.5f, 0.05f, 2.0f), MotionType::Active, 20.0f);
  c.world.addJoint(
      {.body_a = c.ground,
       .body_b = plank,
       .params = HingeJointParams{.anchor_point = Vec3(0.0f, 0.55f, 0.0f), .axis = Vec3::UnitX()}});
  c.add(Vec3(0.0f, 0.62f, 1.5f));
  c.run(2.0f);
  const Vec3 far_end = c.world.states()[plank.index].pose().apply(Vec3(0.0f, 0.0f, -2.0f));
  EXPECT_GT(far_end.y(), 0.8f);
  EXPECT_LT(c.feet().y(), 0.4f);
}

TEST(CharacterAmongBodies, PushesALoosePlankBackWithItsLegs) {
  Course c;
  const BodyId plank = c.addBox(Vec3(0.0f, 0.05f, 0.0f), Vec3(0.5f, 0.05f, 6.0f), MotionType::Active, 80.0f);
  c.world.body(plank).friction = 0.6f;
  c.world.body(c.ground).friction = 0.0f;  // on ice
  c.add(Vec3(0.0f, 0.1f, 0.0f));
  c.run(0.3f);
  c.inputs[0] = {.direction = kAhead};
  c.run(1.5f);
  const float own = c.body().linear_velocity.z(), back = c.world.states()[plank.index].linear_velocity.z();
  EXPECT_NEAR(own - back, 1.6f, 0.05f);
  EXPECT_NEAR(80.0f * own + 80.0f * back, 0.0f, 4.0f) << "momentum";
}

TEST(CharacterAmongBodies, TwoThatWalkIntoEachOtherDoNotOverlap) {
  for (const bool run : {false, true}) {
    Course c;
    c.add(Vec3(0.0f, 0.0f, -3.0f));
    c.add(Vec3(0.05f, 0.0f, 3.0f), kPi);
    c.inputs = {{.direction = kAhead, .run = run}, {.direction = -kAhead, .run = run}};
    float overlap = -1.0f;
    for (int i = 0; i < 360; ++i) {
      c.step();
      const Vec3 apart = c.feet(1) - c.feet(0);
      overlap = std::max(overlap, 0.6f - Vec3(apart.x(), 0.0f, apart.z()).norm());
    }
    RecordProperty(run ? "run_mm" : "walk_mm", std::to_string(1e3f * overlap));
    EXPECT_LT(overlap, 0.02f);
    EXPECT_GT(overlap, -0.01f) << "they met";
  }
}

TEST(CharacterAmongBodies, ACrowdInARingKeepsApart) {
  Course c;
  for (int i = 0; i < 12; ++i) {
    const SinCos turn = sincos(kPi / 6.0f * static_cast<float>(i));
    c.add(Vec3(4.0f * turn.cos, 0.0f, 4.0f * turn.sin));
  }
  float overlap = -1.0f;
  for (int i = 0; i < 300; ++i) {
    for (size_t k = 0; k < c.inputs.size(); ++k) c.inputs[k].direction = -c.feet(k);
    c.step();
    for (size_t a = 0; a < c.inputs.size(); ++a)
      for (size_t b = a + 1; b < c.inputs.size(); ++b)
        overlap = std::max(overlap, 0.6f - (c.feet(a) - c.feet(b)).norm());
  }
  EXPECT_LT(overlap, 0.02f);
}

TEST(CharacterAmongBodies, ABodyThatIsGoneIsLeftAlone) {
  Course c;
  c.add(Vec3::Zero());
  c.add(Vec3(2.0f, 0.0f, 0.0f));
  c.world.removeBody(c.characters[0].body);
  c.run(0.1f);
  EXPECT_EQ(c.characters[1].state, S::Stand);
}

TEST(CharacterAmongBodies, BadInputIsRefused) {
  Course c;
  CharacterDef def;
  def.params.crouch_height = 0.1f;
  EXPECT_THROW(addCharacter(c.world, def), std::invalid_argument);
  def = {};
  def.params.radius = NAN;
  EXPECT_THROW(addCharacter(c.world, def), std::invalid_argument);
  def = {};
  def.feet.x() = INFINITY;
  EXPECT_THROW(addCharacter(c.world, def), std::invalid_argument);
  c.add(Vec3::Zero());
  EXPECT_EQ(updateCharacters(c.world, c.characters, {}, kDt), Error::OutOfRange);
  EXPECT_EQ(updateCharacters(c.world, c.characters, c.inputs, NAN), Error::InvalidValue);
  c.inputs[0].direction = Vec3(NAN, 0.0f, 0.0f);
  c.run(0.1f);
  EXPECT_EQ(c.state(), S::Stand);
  EXPECT_TRUE(c.feet().allFinite());
}

// The same course twice, and once more from a snapshot in the middle of it.
TEST(CharacterAmongBodies, RunsAreTheSameToTheBitAndGoOnFromASnapshot) {
  const auto build = [](Course& c) {
    addStairs(c, 3, 0.3f, 0.4f);
    for (int i = 0; i < 4; ++i)
      c.addBox(Vec3(0.2f * static_cast<float>(i), 0.3f, 1.0f), Vec3(0.3f, 0.3f, 0.2f), MotionType::Active,
               5.0f);
    c.add(Vec3(0.0f, 0.0f, -1.0f));
    c.add(Vec3(0.3f, 0.0f, -2.0f));
  };
  const auto lead = [](Course& c, int i) {
    c.inputs[0] = {.direction = kAhead, .run = i > 60, .jump = i % 90 == 50, .crouch = i > 200 && i < 230};
    c.inputs[1] = {.direction = Vec3(0.1f, 0.0f, 0.9f), .run = true};
    c.step();
  };
  Course first, second, third;
  build(first), build(second), build(third);
  std::vector<std::byte> bytes;
  for (int i = 0; i < 300; ++i) {
    lead(first, i), lead(second, i);
    ASSERT_EQ(first.world.stateHash(), second.world.stateHash()) << i;
    ASSERT_EQ(hashCharacters(first.characters), hashCharacters(second.characters)) << i;
    if (i == 120) {
      bytes.resize(first.world.snapshotBytes());
      first.world.snapshot(bytes);
      third.world.restore(bytes);
      third.characters = first.characters;
    }
    if (i > 120) {
      lead(third, i);
      ASSERT_EQ(first.world.stateHash(), third.world.stateHash()) << i;
    }
  }
}

}  // namespace
