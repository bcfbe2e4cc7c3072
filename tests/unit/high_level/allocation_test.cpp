// The step of a warm world must not touch the heap. Counts every operator new of the process.
#include <gtest/gtest.h>

#include <algorithm>

#include "pfx/high_level/character/character.h"
#include "pfx/high_level/world/world.h"
#include "tests/support/counted_allocations.h"

namespace {

using namespace pfx;

void addBox(World& world, const Vec3& position, const Vec3& half_extent, MotionType type) {
  world.addBody({.name = "box",
                 .pose = {.position = position},
                 .motion_type = type,
                 .shapes = {Shape{Box{half_extent}, {}}},
                 .mass = 1.0f});
}

// 64 boxes: a wall of eight rows, or one row for the world that remembers nothing, in which a wall never
// comes to rest and so goes on finding more contacts than ever before.
void build(World& world) {
  const int rows = world.def().pipeline == Pipeline::Simple ? 1 : 8;
  addBox(world, Vec3(0.0f, -1.0f, 0.0f), Vec3(100.0f, 1.0f, 20.0f), MotionType::Fixed);
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < 64 / rows; ++i)
      addBox(world, Vec3(1.01f * static_cast<float>(i), 0.5f + static_cast<float>(row), 0.0f),
             Vec3::Constant(0.5f), MotionType::Active);
}

class WarmWorld : public testing::TestWithParam<Pipeline> {};

TEST_P(WarmWorld, AWarmStepDoesNotAllocate) {
  WorldDef def;
  def.pipeline = GetParam();
  def.workers = 2;
  World world(def);
  build(world);
  for (int i = 0; i < 120; ++i) world.step(1.0f / 60.0f);
  ASSERT_GT(world.counts().contact_points, 200u) << "the wall must touch, or the test proves nothing";
  const long before = support::g_allocations.load();
  for (int i = 0; i < 600; ++i) world.step(1.0f / 60.0f);
  EXPECT_EQ(support::g_allocations.load() - before, 0);
}

TEST(CharacterAllocation, AWarmCharacterDoesNotAllocate) {
  World world;
  addBox(world, Vec3(0.0f, -1.0f, 0.0f), Vec3(100.0f, 1.0f, 20.0f), MotionType::Fixed);
  for (int i = 0; i < 8; ++i)
    addBox(world, Vec3(4.0f + 2.5f * static_cast<float>(i), 0.1f, 0.0f), Vec3(0.5f, 0.1f, 1.0f),
           i % 2 == 0 ? MotionType::Fixed : MotionType::Active);
  Character characters[2] = {addCharacter(world, {}), addCharacter(world, {.feet = Vec3(1.0f, 0.0f, 0.5f)})};
  CharacterInput inputs[2];
  // To and fro over the same obstacles, of which some are pushed about; the first ways warm the buffers.
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const Vec3 along(i % 600 < 300 ? 1.0f : -1.0f, 0.0f, 0.0f);
      for (CharacterInput& input : inputs)
        input = {.direction = along, .run = true, .jump = i % 100 == 50, .crouch = i % 200 > 170};
      updateCharacters(world, characters, inputs, 1.0f / 60.0f);
      world.step(1.0f / 60.0f);
    }
  };
  run(2400);
  const long before = support::g_allocations.load();
  run(1200);
  EXPECT_EQ(support::g_allocations.load() - before, 0);
}

// Islands that are solved by Newton's method keep their factor.
TEST(Allocation, AWarmColumnDoesNotAllocate) {
  WorldDef def;
  def.workers = 2;
  World world(def);
  addBox(world, Vec3(0.0f, -1.0f, 0.0f), Vec3(100.0f, 1.0f, 20.0f), MotionType::Fixed);
  for (int i = 0; i < 48; ++i)
    addBox(world, Vec3(4.0f * static_cast<float>(i / 16), 0.5f + static_cast<float>(i % 16), 0.0f),
           Vec3::Constant(0.5f), MotionType::Active);
  for (int i = 0; i < 120; ++i) world.step(1.0f / 60.0f);
  const auto stages = world.stages();
  ASSERT_NE(std::find(stages.begin(), stages.end(), "island solver"), stages.end());
  const long before = support::g_allocations.load();
  for (int i = 0; i < 300; ++i) world.step(1.0f / 60.0f);
  EXPECT_EQ(support::g_allocations.load() - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Pipelines, WarmWorld, testing::Values(Pipeline::Simple, Pipeline::Stable));

}  // namespace
