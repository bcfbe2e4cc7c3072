// Islands fall asleep when they rest, cost nothing then, and wake whole when something touches them.
#include <gtest/gtest.h>

#include <algorithm>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;

BodyId addBox(World& world, const Vec3& position, MotionType type = MotionType::Active) {
  const Vec3 half = type == MotionType::Fixed ? Vec3(50.0f, 1.0f, 50.0f) : Vec3(0.5f, 0.5f, 0.5f);
  return world.addBody({.name = "box",
                        .pose = {.position = position},
                        .motion_type = type,
                        .shapes = {Shape{Box{half}, {}}},
                        .mass = 1.0f});
}

// Two columns of three boxes on a floor, far enough apart to be two islands.
struct TwoColumns : testing::Test {
  World world{WorldDef{.sleeping = true}};
  BodyId floor, left[3], right[3];

  void SetUp() override {
    floor = addBox(world, Vec3(0.0f, -1.0f, 0.0f), MotionType::Fixed);
    for (int i = 0; i < 3; ++i) {
      left[i] = addBox(world, Vec3(-5.0f, 0.5f + static_cast<float>(i), 0.0f));
      right[i] = addBox(world, Vec3(5.0f, 0.5f + static_cast<float>(i), 0.0f));
    }
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.step(kStep);
  }
  bool asleep(BodyId id) const { return world.states()[id.index].asleep; }
};

TEST_F(TwoColumns, FallAsleepAfterTheGivenNumberOfSlowSteps) {
  run(static_cast<int>(world.def().sleep_steps));
  EXPECT_FALSE(asleep(left[0]));
  run(60);
  for (const BodyId& id : {left[0], left[2], right[0], right[2]}) EXPECT_TRUE(asleep(id));
  EXPECT_EQ(world.counts().awake, 0u);
}

TEST_F(TwoColumns, SleepersDoNotMoveAndRunNoStage) {
  run(300);
  const uint64_t hash = world.stateHash();
  run(100);
  EXPECT_EQ(world.stateHash(), hash);
  for (const StageTime& stage : world.stageTimes()) EXPECT_STREQ(stage.name, "broad phase") << "nothing else has work";
}

TEST_F(TwoColumns, AFallingBoxWakesTheColumnItHitsAndNoOther) {
  run(300);
  addBox(world, Vec3(-5.0f, 4.5f, 0.0f));
  run(60);
  for (const BodyId& id : left) EXPECT_FALSE(asleep(id));
  for (const BodyId& id : right) EXPECT_TRUE(asleep(id));
}

TEST_F(TwoColumns, RemovingABoxWakesWhatStoodOnIt) {
  run(300);
  world.removeBody(left[0]);
  run(60);
  EXPECT_LT(world.states()[left[2].index].position.y(), 1.7f);
  for (const BodyId& id : right) EXPECT_TRUE(asleep(id));
}

TEST_F(TwoColumns, AChangedVelocityWakesTheWholeColumn) {
  run(300);
  world.state(right[2]).linear_velocity = Vec3(0.0f, 2.0f, 0.0f);
  run(1);
  for (const BodyId& id : right) EXPECT_FALSE(asleep(id));
  EXPECT_GT(world.states()[right[2].index].position.y(), 2.5f);
}

TEST_F(TwoColumns, AWokenColumnGoesOnFromItsOldImpulses) {
  run(300);
  const float height = world.states()[left[2].index].position.y();
  world.state(left[2]);
  run(1);
  EXPECT_FALSE(asleep(left[0]));
  // Without the impulses that were put aside it would sink by some tenths of a millimetre before it finds its balance.
  EXPECT_NEAR(world.states()[left[2].index].position.y(), height, 2e-5f);
}

TEST_F(TwoColumns, AnIslandNamesThePairsThatHoldItTogether) {
  addBox(world, Vec3(-5.0f, 3.02f, 0.9f));  // near the left column, and soon a pair without contact
  run(5);
  ASSERT_GT(world.contactPairs().size(), 6u);
  for (uint32_t k = 0; k < world.numIslands(); ++k) {
    const IslandView island = world.island(k);
    for (uint32_t contact : island.contacts) {
      const Pair& pair = world.contactPairs()[contact];
      EXPECT_FALSE(world.manifolds(pair).empty());
      const auto has = [&](uint32_t body) {
        return std::find(island.bodies.begin(), island.bodies.end(), body) != island.bodies.end();
      };
      EXPECT_TRUE(has(pair.body_a) || has(pair.body_b));
    }
  }
}

TEST_F(TwoColumns, FallAsleepAgainAfterBeingWoken) {
  run(300);
  world.state(left[1]);
  run(300);
  EXPECT_EQ(world.counts().awake, 0u);
}

}  // namespace
