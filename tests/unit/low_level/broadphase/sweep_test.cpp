// The sorted sweep against brute force.
#include "pfx/low_level/broadphase/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/low_level/broadphase/random_proxies.h"

namespace pfx {
namespace {

TEST(SweepBroadphase, findsThePairsOfBruteForceAlongAnyAxis) {
  SweepBroadphase sweep;
  std::size_t found = 0;
  for (uint32_t count : {0u, 1u, 2u, 3u, 5u, 127u, 128u, 129u, 1000u}) {
    for (float extent : {3.0f, 12.0f, 60.0f}) {
      const auto proxies = randomProxies(count, extent, count);
      const auto expected = keys(bruteForcePairs(proxies));
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(keys(sweep.findPairs(proxies, axis)), expected);
      found += expected.size();
    }
  }
  EXPECT_GT(found, 10000u);  // the comparison was of something
}

TEST(SweepBroadphase, givesTheSamePairsForAnyNumberOfWorkers) {
  const auto proxies = randomProxies(3000, 25.0f, 5);
  SweepBroadphase serial;
  const auto expected = keys(serial.findPairs(proxies, 1));
  for (int workers : {1, 2, 3, 4}) {
    TaskManager tasks(workers, Sharing::Always);
    SweepBroadphase sweep;
    for (int round = 0; round < 3; ++round) EXPECT_EQ(keys(sweep.findPairs(proxies, 1, &tasks)), expected);
  }
}

TEST(SweepBroadphase, countsTouchingBoundsAsOverlap) {
  std::vector<BroadphaseProxy> proxies(2);
  proxies[0].bounds = {Vec3::Zero(), Vec3::Ones()};
  proxies[1].bounds = {Vec3(1, 0, 0), Vec3(2, 1, 1)};
  proxies[1].body = 1;
  SweepBroadphase sweep;
  EXPECT_EQ(sweep.findPairs(proxies, 0).size(), 1u);
  proxies[1].bounds.min.x() = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(sweep.findPairs(proxies, 0).size(), 0u);
}

TEST(SweepBroadphase, skipsBoundsThatAreNotNumbersAndFindsAllOthers) {
  auto proxies = randomProxies(300, 4.0f, 9);
  auto sound = proxies;
  const float nan = NAN;
  for (uint32_t i = 0; i < 60; ++i) {
    BroadphaseProxy bad = proxies[i];
    bad.body = 1000 + i;
    const float value = i % 3 == 0 ? nan : i % 3 == 1 ? -nan : bad.bounds.max.y() + 1.0f;
    (i % 2 == 0 || i % 3 == 2 ? bad.bounds.min : bad.bounds.max)[i % 3 == 2 ? 1 : i % 5 % 3] = value;
    proxies.insert(proxies.begin() + i * 5, bad);
  }
  SweepBroadphase sweep;
  const auto expected = keys(bruteForcePairs(sound));
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(keys(sweep.findPairs(proxies, axis)), expected);
}

TEST(SweepBroadphase, reportsAFullBufferOfTheCallerAndSucceedsWithALargerOne) {
  const auto proxies = randomProxies(500, 8.0f, 2);
  const auto expected = keys(bruteForcePairs(proxies));
  SweepBroadphase sweep;
  std::vector<Pair> pairs(expected.size() - 1);
  const FindPairsResult full = findPairs(sweep, proxies, 2, pairs);
  EXPECT_EQ(full.error, Error::OutOfMaxPairs);
  ASSERT_EQ(full.num_pairs, expected.size());
  pairs.resize(full.num_pairs);
  const FindPairsResult retry = findPairs(sweep, proxies, 2, pairs);
  EXPECT_EQ(retry.error, Error::Ok);
  EXPECT_EQ(keys(pairs), expected);
  EXPECT_EQ(findPairs(sweep, proxies, 3, pairs).error, Error::OutOfRange);
}

TEST(SweepBroadphase, followsTheTableOfMotionTypesAndTheFilters) {
  std::vector<BroadphaseProxy> two(2);
  two[0].bounds = two[1].bounds = {Vec3::Zero(), Vec3::Ones()};
  two[1].body = 1;
  SweepBroadphase sweep;
  for (int a = 0; a < kNumMotionTypes; ++a) {
    for (int b = 0; b < kNumMotionTypes; ++b) {
      two[0].motion_type = static_cast<MotionType>(a), two[1].motion_type = static_cast<MotionType>(b);
      EXPECT_EQ(sweep.findPairs(two, 0).size() == 1,
                detectsCollision(two[0].motion_type, two[1].motion_type));
    }
  }
  two[0].motion_type = two[1].motion_type = MotionType::Active;
  two[0].filter_self = 1, two[0].filter_target = 2, two[1].filter_self = 2, two[1].filter_target = 1;
  EXPECT_EQ(sweep.findPairs(two, 0).size(), 1u);
  two[1].filter_target = 2;  // one side that refuses is enough
  EXPECT_EQ(sweep.findPairs(two, 0).size(), 0u);
}

}  // namespace
}  // namespace pfx
