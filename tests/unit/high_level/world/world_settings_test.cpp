// Gravity and the world box, changed while the world runs.
#include <gtest/gtest.h>

#include <limits>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;

void addGround(World& world) {
  world.addBody({.name = "ground",
                 .pose = {.position = Vec3(0.0f, -1.0f, 0.0f)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {Shape{Box{Vec3(50.0f, 1.0f, 50.0f)}, {}}}});
}

BodyId addBox(World& world, const Vec3& position) {
  return world.addBody({.name = "box", .pose = {.position = position}, .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
}

void run(World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step(kDt);
}

class WorldSettings : public testing::TestWithParam<Pipeline> {};
INSTANTIATE_TEST_SUITE_P(Pipelines, WorldSettings, testing::Values(Pipeline::Simple, Pipeline::Stable));

TEST_P(WorldSettings, GravityThatIsSetActsInTheNextStep) {
  World world({.pipeline = GetParam()});
  const BodyId box = addBox(world, Vec3::Zero());
  run(world, 1);
  EXPECT_NEAR(world.states()[box.index].linear_velocity.y(), -9.8f * kDt, 1e-5f);
  world.setGravity(Vec3(3.0f, 0.0f, 0.0f));
  run(world, 1);
  EXPECT_NEAR(world.states()[box.index].linear_velocity.y(), -9.8f * kDt, 1e-5f);
  EXPECT_NEAR(world.states()[box.index].linear_velocity.x(), 3.0f * kDt, 1e-5f);
  EXPECT_EQ(world.def().gravity, Vec3(3.0f, 0.0f, 0.0f));
}

TEST(WorldSettingsOfSleepers, AnotherGravityWakesThemAndTheSameDoesNot) {
  World world({.sleeping = true, .sleep_steps = 20});
  addGround(world);
  const BodyId box = addBox(world, Vec3(0.0f, 0.5f, 0.0f)), far = addBox(world, Vec3(9.0f, 0.5f, 0.0f));
  run(world, 120);
  ASSERT_EQ(world.counts().awake, 0u);
  world.setGravity(world.def().gravity);
  EXPECT_EQ(world.counts().awake, 0u);
  world.setGravity(Vec3(0.0f, 2.0f, 0.0f));
  EXPECT_EQ(world.counts().awake, 2u);
  run(world, 60);  // they rise: y = a t^2 / 2
  for (const BodyId id : {box, far}) EXPECT_NEAR(world.states()[id.index].position.y(), 1.5f, 0.05f);
}

TEST_P(WorldSettings, BodiesOutsideOfTheBoxCollideWithNothing) {
  World world({.pipeline = GetParam()});
  addGround(world);
  const BodyId inside = addBox(world, Vec3(0.0f, 0.5f, 0.0f)), outside = addBox(world, Vec3(20.0f, 0.5f, 0.0f));
  world.setBox(Vec3::Zero(), Vec3(10.0f, 100.0f, 10.0f));
  run(world, 60);
  EXPECT_NEAR(world.states()[inside.index].position.y(), 0.5f, 0.01f);
  EXPECT_NEAR(world.states()[outside.index].position.y(), 0.5f - 4.9f, 0.15f);  // g t^2 / 2, of semi-implicit steps
}

TEST(WorldSettingsOfSleepers, AnotherBoxWakesThemAndIsWhereItIsSet) {
  World world({.sleeping = true, .sleep_steps = 20});
  addGround(world);
  const BodyId left = addBox(world, Vec3(-20.0f, 0.5f, 0.0f)), right = addBox(world, Vec3(20.0f, 0.5f, 0.0f));
  run(world, 120);
  ASSERT_EQ(world.counts().awake, 0u);
  world.setBox(Vec3(-20.0f, 0.0f, 0.0f), Vec3::Constant(5.0f));
  EXPECT_EQ(world.counts().awake, 2u);
  run(world, 30);
  EXPECT_NEAR(world.states()[left.index].position.y(), 0.5f, 0.01f);
  EXPECT_LT(world.states()[right.index].position.y(), -0.5f);
  // Widened again, it holds what it did not hold before.
  world.state(right).position = Vec3(20.0f, 0.6f, 0.0f);
  world.state(right).linear_velocity = Vec3::Zero();
  world.setBox(Vec3::Zero(), Vec3::Constant(100.0f));
  run(world, 60);
  EXPECT_NEAR(world.states()[right.index].position.y(), 0.5f, 0.02f);
}

TEST(WorldSettingsRefused, AreValuesThatAreNone) {
  World world;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(world.setGravity(Vec3(0.0f, nan, 0.0f)), std::invalid_argument);
  EXPECT_THROW(world.setBox(Vec3::Zero(), Vec3(1.0f, 0.0f, 1.0f)), std::invalid_argument);
  EXPECT_THROW(world.setBox(Vec3(nan, 0.0f, 0.0f), Vec3::Ones()), std::invalid_argument);
  EXPECT_EQ(world.def().gravity, WorldDef{}.gravity);
  EXPECT_EQ(world.def().extent, WorldDef{}.extent);
}

}  // namespace
