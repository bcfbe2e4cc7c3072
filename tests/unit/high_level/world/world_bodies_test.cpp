// Bodies that come and go: handles, and places that are used again.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;

// HL-05, beside a map of what ought to be there.
TEST(WorldBodies, ComeAndGoTenThousandTimes) {
  constexpr size_t kMost = 50;
  World world;
  const BodyId ground = world.addBody({.name = "ground",
                                       .pose = {.position = Vec3(0.0f, -1.0f, 0.0f)},
                                       .motion_type = MotionType::Fixed,
                                       .shapes = {Shape{Box{Vec3(100.0f, 1.0f, 100.0f)}, {}}}});
  std::mt19937 random(3);
  std::map<uint32_t, BodyId> alive;  // by index
  std::vector<BodyId> dead;
  int added = 0, removed = 0;
  for (int i = 0; i < 10000; ++i) {
    if (alive.empty() || (alive.size() < kMost && random() % 2 == 0)) {
      const Vec3 at(static_cast<float>(random() % 20), 0.5f, static_cast<float>(random() % 20));
      const BodyId id = world.addBody(
          {.name = "body " + std::to_string(i), .pose = {.position = at}, .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
      ASSERT_TRUE(alive.emplace(id.index, id).second) << "the place was taken";
      ASSERT_EQ(world.name(id.index), "body " + std::to_string(i));
      ++added;
    } else {
      auto chosen = alive.begin();
      std::advance(chosen, static_cast<std::ptrdiff_t>(random() % alive.size()));
      world.removeBody(chosen->second);
      dead.push_back(chosen->second);
      alive.erase(chosen);
      ++removed;
    }
    if (i % 100 != 0) continue;
    world.step(kDt);
    ASSERT_EQ(world.counts().bodies, alive.size() + 1);
    for (const auto& [index, id] : alive) ASSERT_TRUE(world.isValid(id)) << index;
    for (const BodyId id : dead) ASSERT_FALSE(world.isValid(id)) << id.index;
  }
  EXPECT_GT(std::min(added, removed), 4000);
  EXPECT_LE(world.states().size(), kMost + 1) << "places are used again";
  EXPECT_TRUE(world.isValid(ground));
  for (const BodyId id : dead) EXPECT_THROW(world.state(id), std::invalid_argument);
}

TEST(WorldBodies, ARemovedOneIsInert) {
  World world;
  const BodyId shelf = world.addBody(
      {.name = "shelf", .motion_type = MotionType::Fixed, .shapes = {Shape{Box{Vec3(2.0f, 0.5f, 2.0f)}, {}}}});
  const BodyId box = world.addBody(
      {.name = "box", .pose = {.position = Vec3(0.0f, 1.0f, 0.0f)}, .shapes = {Shape{Box{Vec3::Constant(0.5f)}, {}}}});
  for (int i = 0; i < 30; ++i) world.step(kDt);
  ASSERT_EQ(world.counts().touching_pairs, 1u);
  world.removeBody(shelf);
  world.removeBody(shelf);  // nothing happens
  const uint64_t steps = 30;
  for (uint64_t i = 0; i < steps; ++i) world.step(kDt);
  EXPECT_EQ(world.counts().touching_pairs, 0u);
  EXPECT_LT(world.states()[box.index].position.y(), 0.0f) << "the box falls through where it was";
  EXPECT_FALSE(world.castRay({.start = Vec3(1.5f, 5.0f, 0.0f), .direction = Vec3(0.0f, -20.0f, 0.0f)}).hit);
}

}  // namespace
