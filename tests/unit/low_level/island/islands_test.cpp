// Islands against a flood fill.
#include "pfx/low_level/island/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pfx {
namespace {

std::vector<uint32_t> toVector(std::span<const uint32_t> s) { return {s.begin(), s.end()}; }

TEST(Islands, areNumberedByTheirLowestBody) {
  const std::vector<uint32_t> active = {0, 1, 2, 3, 4, 5};
  const std::vector<Link> links = {{5, 3}, {4, 1}, {3, 1}};
  Islands islands;
  ASSERT_EQ(islands.build(6, active, links), Error::Ok);
  ASSERT_EQ(islands.size(), 3u);
  EXPECT_EQ(toVector(islands.bodies(0)), (std::vector<uint32_t>{0}));
  EXPECT_EQ(toVector(islands.bodies(1)), (std::vector<uint32_t>{1, 3, 4, 5}));
  EXPECT_EQ(toVector(islands.bodies(2)), (std::vector<uint32_t>{2}));
  EXPECT_EQ(toVector(islands.links(1)), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_TRUE(islands.links(0).empty());
}

TEST(Islands, areNotMergedByFixedKeyframeTriggerOrSleepingBodies) {
  std::vector<RigidState> states(7);
  states[2].motion_type = MotionType::Fixed;
  states[3].motion_type = MotionType::Keyframe;
  states[4].motion_type = MotionType::Trigger;
  states[5].asleep = true;
  states[6].motion_type = MotionType::OneWay;
  std::vector<Link> links;
  for (uint32_t middle : {2u, 3u, 4u, 5u}) links.push_back({0, middle}), links.push_back({middle, 1});
  links.push_back({2, 3});  // no active body: in no island
  Islands islands;
  ASSERT_EQ(islands.build(states, links), Error::Ok);
  ASSERT_EQ(islands.size(), 3u);
  EXPECT_EQ(toVector(islands.links(0)), (std::vector<uint32_t>{0, 2, 4, 6}));
  EXPECT_EQ(toVector(islands.links(1)), (std::vector<uint32_t>{1, 3, 5, 7}));
  EXPECT_EQ(islands.islandOf(6), 2u);
  EXPECT_EQ(islands.islandOf(2), kNoIsland);

  links.push_back({6, 0});  // a one-way body is dynamic and connects
  ASSERT_EQ(islands.build(states, links), Error::Ok);
  EXPECT_EQ(islands.size(), 2u);
}

TEST(Islands, equalAFloodFillForRandomLinksAndDoNotDependOnTheirOrder) {
  std::mt19937 random(7);
  Islands islands;  // reused: what one build leaves must not reach the next
  for (int round = 0; round < 60; ++round) {
    const uint32_t n = 1 + random() % 300;
    std::vector<uint32_t> active;
    std::vector<uint8_t> is_active(n, 0);
    for (uint32_t b = 0; b < n; ++b) {
      if (random() % 4 != 0) active.push_back(b), is_active[b] = 1;
    }
    std::vector<Link> links(random() % (n + 1));
    for (Link& l : links) {
      l.body_a = random() % n;
      l.body_b = random() % n;
    }
    // Lowest reachable body, by relaxation until nothing changes.
    std::vector<uint32_t> lowest(n);
    for (uint32_t b = 0; b < n; ++b) lowest[b] = b;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Link& l : links) {
        if (!is_active[l.body_a] || !is_active[l.body_b] || lowest[l.body_a] == lowest[l.body_b]) continue;
        lowest[l.body_a] = lowest[l.body_b] = std::min(lowest[l.body_a], lowest[l.body_b]);
        changed = true;
      }
    }
    ASSERT_EQ(islands.build(n, active, links), Error::Ok);
    uint32_t bodies = 0, previous = 0;
    for (uint32_t i = 0; i < islands.size(); ++i) {
      const auto list = islands.bodies(i);
      ASSERT_FALSE(list.empty());
      ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
      ASSERT_TRUE(i == 0 || list[0] > previous);
      previous = list[0];
      for (uint32_t b : list) ASSERT_EQ(lowest[b], list[0]);
      bodies += static_cast<uint32_t>(list.size());
    }
    ASSERT_EQ(bodies, active.size());
    for (uint32_t i = 0; i < links.size(); ++i) {
      uint32_t expected = islands.islandOf(links[i].body_a);
      if (expected == kNoIsland) expected = islands.islandOf(links[i].body_b);
      for (uint32_t k = 0; k < islands.size(); ++k) {
        const auto list = islands.links(k);
        ASSERT_EQ(std::binary_search(list.begin(), list.end(), i), k == expected);
      }
    }
    std::vector<uint32_t> before;
    for (uint32_t b = 0; b < n; ++b) before.push_back(islands.islandOf(b));
    std::shuffle(links.begin(), links.end(), random);
    ASSERT_EQ(islands.build(n, active, links), Error::Ok);
    for (uint32_t b = 0; b < n; ++b) ASSERT_EQ(islands.islandOf(b), before[b]);
  }
}

TEST(Islands, refuseBodiesThatAreNotAscendingOrOutOfRange) {
  Islands islands;
  EXPECT_EQ(islands.build(3, std::vector<uint32_t>{0, 3}, {}), Error::OutOfRange);
  EXPECT_EQ(islands.build(3, std::vector<uint32_t>{1, 0}, {}), Error::OutOfRange);
  EXPECT_EQ(islands.build(3, std::vector<uint32_t>{1, 1}, {}), Error::OutOfRange);
  EXPECT_EQ(islands.size(), 0u);
  EXPECT_EQ(islands.build(0, {}, {}), Error::Ok);
  EXPECT_EQ(islands.size(), 0u);
}

TEST(Islands, ignoreLinksToBodiesThatDoNotExist) {
  Islands islands;
  const std::vector<Link> links = {{0, 0xffffffffu}, {7, 1}, {9, 8}};
  ASSERT_EQ(islands.build(2, std::vector<uint32_t>{0, 1}, links), Error::Ok);
  ASSERT_EQ(islands.size(), 2u);
  EXPECT_EQ(toVector(islands.links(0)), (std::vector<uint32_t>{0}));
  EXPECT_EQ(toVector(islands.links(1)), (std::vector<uint32_t>{1}));
}

}  // namespace
}  // namespace pfx
