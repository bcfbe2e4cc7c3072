// The step of a warm world must not touch the heap. Counts every operator new of the process.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include "pfx/high_level/world/world.h"

namespace {

std::atomic<long> g_allocations{0};

}  // namespace

// The compiler cannot see that both sides are replaced together.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++g_allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

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
  const long before = g_allocations.load();
  for (int i = 0; i < 600; ++i) world.step(1.0f / 60.0f);
  EXPECT_EQ(g_allocations.load() - before, 0);
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
  const long before = g_allocations.load();
  for (int i = 0; i < 300; ++i) world.step(1.0f / 60.0f);
  EXPECT_EQ(g_allocations.load() - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Pipelines, WarmWorld, testing::Values(Pipeline::Simple, Pipeline::Stable));

}  // namespace
