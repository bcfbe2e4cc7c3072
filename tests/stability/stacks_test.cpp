// Stacks of the sample scenes over a minute, without sleep: they stand, hardly sink, and overlap by less than
// a millimetre.
#include <gtest/gtest.h>

#include <algorithm>

#include "samples/shared/builders.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;
constexpr int kMinute = 3600;

struct Rest {
  float drift = 0.0f;        // m, largest of any box
  float penetration = 0.0f;  // m, deepest
};

float deepest(const World& world) {
  float depth = 0.0f;
  for (const Pair& pair : world.contactPairs())
    for (const ContactManifold& m : world.manifolds(pair))
      for (int i = 0; i < m.num_points; ++i) depth = std::max(depth, -m.points[i].distance);
  return depth;
}

Rest restAfterAMinute(World& world) {
  const std::vector<RigidState> start(world.states().begin(), world.states().end());
  for (int i = 0; i < kMinute; ++i) world.step(kStep);
  Rest rest{.penetration = deepest(world)};
  for (size_t i = 0; i < start.size(); ++i)
    rest.drift = std::max(rest.drift, (world.states()[i].position - start[i].position).norm());
  return rest;
}

TEST(Stacks, APyramidOfTwentyRowsStandsForAMinute) {
  World world;
  samples::addGround(world);
  samples::addPyramid(world, {});
  ASSERT_EQ(world.counts().awake, 210u);
  const Rest rest = restAfterAMinute(world);
  RecordProperty("drift_mm", std::to_string(1e3f * rest.drift));
  RecordProperty("penetration_mm", std::to_string(1e3f * rest.penetration));
  EXPECT_LT(rest.drift, 0.010f);
  EXPECT_LT(rest.penetration, 0.001f);
  EXPECT_EQ(world.counts().awake, 210u);
}

TEST(Stacks, ATowerOfEightRingsStandsForAMinute) {
  World world;
  samples::addGround(world);
  samples::addTower(world, {});
  const Rest rest = restAfterAMinute(world);
  RecordProperty("drift_mm", std::to_string(1e3f * rest.drift));
  RecordProperty("penetration_mm", std::to_string(1e3f * rest.penetration));
  EXPECT_LT(rest.drift, 0.010f);
  EXPECT_LT(rest.penetration, 0.001f);
}

// What the cache is for: without it the same tower slides apart (sample 1_simple).
TEST(Stacks, ATowerThatRemembersNothingStandsWorse) {
  const auto driftWith = [](Pipeline pipeline) {
    WorldDef def;
    def.pipeline = pipeline;
    World world(def);
    samples::addGround(world);
    samples::addTower(world, {});
    const std::vector<RigidState> start(world.states().begin(), world.states().end());
    for (int i = 0; i < 600; ++i) world.step(kStep);
    float drift = 0.0f;
    for (size_t i = 0; i < start.size(); ++i)
      drift = std::max(drift, (world.states()[i].position - start[i].position).norm());
    return drift;
  };
  const float simple = driftWith(Pipeline::Simple), stable = driftWith(Pipeline::Stable);
  RecordProperty("simple_mm", std::to_string(1e3f * simple));
  RecordProperty("stable_mm", std::to_string(1e3f * stable));
  EXPECT_GT(simple, 10.0f * stable);
}

TEST(Stacks, TheStateIsTheSameForAnyNumberOfWorkersAndAnyLaneWidth) {
  const auto hashWith = [](int workers, SimdLevel simd) {
    WorldDef def;
    def.workers = workers;
    def.simd = simd;
    World world(def);
    samples::addGround(world);
    samples::addPyramid(world, {});
    for (int i = 0; i < 200; ++i) world.step(kStep);
    return world.stateHash();
  };
  const uint64_t one = hashWith(1, SimdLevel::Sse2);
  for (const int workers : {1, 2, 3, 4})
    EXPECT_EQ(hashWith(workers, SimdLevel::Auto), one) << workers << " workers";
}

}  // namespace
