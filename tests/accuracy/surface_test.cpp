// Surfaces that resist rolling and spinning, belts, and how the coefficients of a pair are mixed, against closed forms.
#include <gtest/gtest.h>

#include "pfx/high_level/scene_file/scene_file.h"
#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

constexpr float kRadius = 0.5f;

BodyDef floorDef(float friction) {
  return {.pose = {.position = Vec3(0, -1, 0)},
          .motion_type = MotionType::Fixed,
          .shapes = {{Box{Vec3(100, 1, 100)}}},
          .restitution = 0.0f,
          .friction = friction};
}

BodyDef ballDef(float rolling_resistance) {
  return {.pose = {.position = Vec3(0, kRadius, 0)},
          .shapes = {{Sphere{kRadius}}},
          .restitution = 0.0f,
          .friction = 0.6f,
          .rolling_resistance = rolling_resistance};
}

BodyDef boxDef(float friction) {
  return {.pose = {.position = Vec3(0, 0.25f, 0)},
          .shapes = {{Box{Vec3(0.5f, 0.25f, 0.5f)}}},
          .restitution = 0.0f,
          .friction = friction};
}

void run(World& world, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 60.0 + 0.5); ++i) world.step(kDt);
}

// A ball that rolls is braked by the torque c N; with I = 2/5 m r^2 its centre slows down by 5/7 c / r g.
TEST(Surfaces, ABallRollsAsFarAsItsResistanceLetsIt) {
  Worst error;
  for (const float resistance : {0.005f, 0.02f, 0.1f}) {
    World world(worldDef(4));
    world.addBody(floorDef(0.6f));
    const BodyId ball = world.addBody(ballDef(resistance));
    const float speed = 2.0f;
    world.state(ball).linear_velocity = Vec3(speed, 0, 0);
    world.state(ball).angular_velocity = Vec3(0, 0, -speed / kRadius);
    const double a = 5.0 / 7.0 * static_cast<double>(resistance / kRadius) * kGravity;
    run(world, speed / a + 1.0);
    const RigidState& s = world.states()[ball.index];
    error.add(s.position.x() / (0.5 * speed * speed / a) - 1.0);
    EXPECT_LT(s.linear_velocity.norm(), 1e-4f);
  }
  report("rolling resistance, way until rest, relative", error.value, 1e-2, "");
  EXPECT_LT(std::abs(error.value), 1e-2);
}

// It stays on a slope whose tangent is below c / r, and rolls down one above.
TEST(Surfaces, ABallStaysOnASlopeBelowItsResistance) {
  const double critical = 0.1;
  for (const double share : {0.9, 1.1}) {
    const double angle = std::atan(share * critical);
    WorldDef def = worldDef(4);
    def.gravity = static_cast<float>(kGravity) *
                  Vec3(static_cast<float>(std::sin(angle)), -static_cast<float>(std::cos(angle)), 0);
    World world(def);
    world.addBody(floorDef(0.6f));
    const BodyId ball = world.addBody(ballDef(static_cast<float>(critical) * kRadius));
    run(world, 5.0);
    const double way = world.states()[ball.index].position.x();
    if (share < 1.0) {
      report("rolling resistance, creep on a slope in 5 s", way, 1e-3, "m");
      EXPECT_LT(std::abs(way), 1e-3);
    } else {
      const double a = 5.0 / 7.0 * kGravity * (std::sin(angle) - critical * std::cos(angle));
      report("rolling resistance, way down a slope, relative", way / (12.5 * a) - 1.0, 2e-2, "");
      EXPECT_LT(std::abs(way / (12.5 * a) - 1.0), 2e-2);
    }
  }
}

// A ball that spins on the spot: I w' = -c m g.
TEST(Surfaces, ABallThatSpinsIsStoppedByTorsionalResistance) {
  World world(worldDef(4));
  world.addBody(floorDef(0.6f));
  BodyDef def = ballDef(0.0f);
  def.surface.torsional_resistance = 0.01f;
  const BodyId ball = world.addBody(def);
  world.state(ball).angular_velocity = Vec3(0, 2, 0);
  run(world, 1.0);
  const double expected = 2.0 - 0.01 * kGravity / (0.4 * static_cast<double>(kRadius * kRadius));
  const double spin = world.states()[ball.index].angular_velocity.y();
  report("torsional resistance, spin after a second, relative", spin / expected - 1.0, 1e-3, "");
  EXPECT_NEAR(spin / expected, 1.0, 1e-3);
  run(world, 2.0);
  EXPECT_LT(world.states()[ball.index].angular_velocity.norm(), 1e-4f);
}

// What lies on a belt is taken along with mu g until it is as fast.
TEST(Surfaces, ABeltTakesABoxAlong) {
  World world(worldDef(4));
  BodyDef belt = floorDef(0.3f);
  belt.pose.orientation = Quat(Eigen::AngleAxisf(static_cast<float>(M_PI / 2), Vec3::UnitY()));
  belt.surface.velocity = Vec3(2, 5, 0);  // along x of the belt, which is -z of the world; y leaves the plane
  world.addBody(belt);
  const BodyId box = world.addBody(boxDef(0.3f));
  const double a = 0.3 * kGravity, time = 2.0 / a;
  run(world, 3.0);
  const RigidState& s = world.states()[box.index];
  const double way = -s.position.z() / (0.5 * a * time * time + 2.0 * (3.0 - time)) - 1.0;
  report("belt, way in 3 s, relative", way, 1e-3, "");
  EXPECT_LT(std::abs(way), 1e-3);
  EXPECT_NEAR(s.linear_velocity.z(), -2.0f, 1e-4f);
  EXPECT_NEAR(s.position.y(), 0.25f, 1e-3f);
}

TEST(Surfaces, ABeltThatIsSetWakesWhatSleepsOnIt) {
  WorldDef def = worldDef(4);
  def.sleeping = true;
  def.sleep_steps = 10;
  World world(def);
  const BodyId belt = world.addBody(floorDef(0.6f));
  const BodyId box = world.addBody(boxDef(0.6f));
  run(world, 1.0);
  ASSERT_TRUE(world.states()[box.index].asleep);
  world.setSurface(belt, {.velocity = Vec3(1, 0, 0)});
  run(world, 1.0);
  EXPECT_NEAR(world.states()[box.index].linear_velocity.x(), 1.0f, 1e-4f);
}

TEST(Surfaces, MixingSaysWhichFrictionAPairHas) {
  const struct {
    Mixing mixing;
    double friction;
  } cases[] = {{Mixing::GeometricMean, 0.4}, {Mixing::Mean, 0.5}, {Mixing::Smaller, 0.2}, {Mixing::Larger, 0.8}, {Mixing::Product, 0.16}};
  for (const auto& [mixing, friction] : cases) {
    WorldDef def = worldDef(4);
    def.friction_mixing = mixing;
    World world(def);
    world.addBody(floorDef(0.2f));
    const BodyId box = world.addBody(boxDef(0.8f));
    world.state(box).linear_velocity = Vec3(4, 0, 0);
    run(world, 4.0);
    EXPECT_NEAR(world.states()[box.index].position.x() / (16.0 / (2.0 * friction * kGravity)), 1.0, 2e-3);
  }
}

TEST(Surfaces, RestitutionIsMixedLikewise) {
  WorldDef def = worldDef(4);
  def.restitution_mixing = Mixing::Larger;
  World world(def);
  world.addBody(floorDef(0.6f));
  BodyDef ball = ballDef(0.0f);
  ball.restitution = 1.0f;
  ball.pose.position.y() = kRadius + 1.0f;
  const BodyId id = world.addBody(ball);
  float highest = 0.0f;
  for (int i = 0; i < 60; ++i) {
    world.step(kDt);
    if (i > 30) highest = std::max(highest, world.states()[id.index].position.y() - kRadius);
  }
  EXPECT_NEAR(highest, 1.0f, 2e-2f);
}

World makeScene() {
  WorldDef def = worldDef(4);
  def.friction_mixing = Mixing::Larger;
  def.restitution_mixing = Mixing::Product;
  World world(def);
  BodyDef belt = floorDef(0.3f);
  belt.surface.velocity = Vec3(0.5f, 0, 0.25f);
  world.addBody(belt);
  BodyDef ball = ballDef(0.01f);
  ball.surface.torsional_resistance = 0.02f;
  ball.angular_velocity = Vec3(0, 8, 0);
  world.addBody(ball);
  return world;
}

TEST(Surfaces, AreInScenesAndSnapshots) {
  World world = makeScene();
  World read;
  loadScene(SceneText{.xml = writeScene(world)}, read);
  EXPECT_EQ(read.def().friction_mixing, Mixing::Larger);
  EXPECT_EQ(read.def().restitution_mixing, Mixing::Product);
  EXPECT_EQ(read.surface(0), world.surface(0));
  EXPECT_EQ(read.surface(1), world.surface(1));

  run(world, 0.25);
  std::vector<std::byte> bytes(world.snapshotBytes());
  world.snapshot(bytes);
  World other;
  other.restore(bytes);
  run(world, 0.5);
  run(other, 0.5);
  EXPECT_EQ(world.stateHash(), other.stateHash());
}

TEST(Surfaces, AreRefusedWhereTheyMakeNoSense) {
  World world(worldDef(4));
  BodyDef def = ballDef(0.0f);
  def.surface.torsional_resistance = -1.0f;
  EXPECT_THROW(world.addBody(def), std::invalid_argument);
  const BodyId ball = world.addBody(ballDef(0.0f));
  EXPECT_THROW(world.setSurface(ball, {.velocity = Vec3::Constant(NAN)}), std::invalid_argument);
  EXPECT_EQ(world.surface(ball.index), Surface{});
}

// Remembered impulses are those of a sub-step, and stand for forces: they are scaled when the sub-step changes. A box on a
// slope just below its critical angle would slip in the first longer step, before its friction is found again.
TEST(Surfaces, ABoxOnASlopeDoesNotNoticeAnotherStep) {
  const double angle = std::atan(0.6) - 0.002;
  WorldDef def = worldDef(4);
  def.gravity =
      static_cast<float>(kGravity) * Vec3(static_cast<float>(std::sin(angle)), -static_cast<float>(std::cos(angle)), 0);
  World world(def);
  world.addBody(floorDef(0.6f));
  const BodyId box = world.addBody(boxDef(0.6f));
  run(world, 2.0);
  const float before = world.states()[box.index].position.x();
  world.step(1.0f / 30.0f);
  world.setSolver({.substeps = 2});
  for (int i = 0; i < 10; ++i) world.step(1.0f / 30.0f);
  const double slip = world.states()[box.index].position.x() - before;
  report("box on a slope when the step changes: slip", slip, 1e-4, "m");
  EXPECT_LT(std::abs(slip), 1e-4);
}

}  // namespace
}  // namespace pfx_test
