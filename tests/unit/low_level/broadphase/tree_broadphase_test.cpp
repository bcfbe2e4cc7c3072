// The tree broad phase against brute force and the sweep, through long random lives.
#include "pfx/low_level/broadphase/tree_broadphase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "pfx/low_level/broadphase/sweep.h"
#include "tests/unit/low_level/broadphase/random_proxies.h"

namespace pfx {
namespace {

// A broad phase beside the list of proxies that it stands for.
struct Life {
  explicit Life(uint32_t seed, float extent_in) : random(seed), extent(extent_in) {}

  BroadphaseProxy randomProxy(uint32_t body) {
    BroadphaseProxy p = randomProxies(1, extent, random())[0];
    p.body = body;
    return p;
  }
  void rest(const std::vector<BroadphaseProxy>& proxies) {
    for (const BroadphaseProxy& p : proxies) all[p.body] = p, awake.erase(p.body);
    ASSERT_EQ(tree.rest(proxies), Error::Ok);
  }
  void remove(uint32_t body) {
    all.erase(body);
    awake.erase(body);
    tree.remove(body);
  }
  void update(TaskManager* tasks) {
    std::vector<BroadphaseProxy> active;
    for (uint32_t body : awake) active.push_back(all[body]);
    ASSERT_EQ(tree.update(active, tasks), Error::Ok);
  }
  std::vector<BroadphaseProxy> list() const {
    std::vector<BroadphaseProxy> proxies;
    for (const auto& [body, proxy] : all) proxies.push_back(proxy);
    return proxies;
  }
  void check() {
    const auto proxies = list();
    const auto expected = keys(bruteForcePairs(proxies));
    ASSERT_EQ(keys(tree.pairs()), expected);
    ASSERT_EQ(keys(sweep.findPairs(proxies, 0)), expected);
    std::vector<uint64_t> active, resting;
    for (uint64_t key : expected) {
      const bool is_active = awake.contains(uint32_t(key >> 32)) || awake.contains(uint32_t(key));
      (is_active ? active : resting).push_back(key);
    }
    ASSERT_EQ(keys(tree.activePairs()), active);
    ASSERT_EQ(keys(tree.restingPairs()), resting);
    pairs_seen += expected.size();
    resting_seen += resting.size();
  }

  std::mt19937 random;
  float extent;
  std::map<uint32_t, BroadphaseProxy> all;
  std::set<uint32_t> awake;
  TreeBroadphase tree;
  SweepBroadphase sweep;
  std::size_t pairs_seen = 0, resting_seen = 0;
};

// One step of a random life: bodies appear, vanish, wake, fall asleep, drift, jump, change their kind.
void live(Life& life, TaskManager* tasks) {
  auto& random = life.random;
  for (int i = 0; i < 4; ++i) {
    const uint32_t body = random() % 300;
    if (life.all.contains(body)) {
      if (random() % 3 == 0) life.remove(body);
    } else if (random() % 2 == 0) {
      life.rest({life.randomProxy(body)});
    } else {
      life.all[body] = life.randomProxy(body);
      life.awake.insert(body);
    }
  }
  for (auto& [body, proxy] : life.all) {
    const uint32_t dice = random() % 100;
    if (!life.awake.contains(body)) {
      if (dice < 4) life.awake.insert(body);
      continue;
    }
    if (dice < 3 && life.tree.contains(body)) life.awake.erase(body);
    Vec3 step = randomVector(random, -0.05f, 0.05f);
    if (dice > 95) step *= 200.0f;
    if (!life.awake.contains(body)) continue;
    proxy.bounds.min += step, proxy.bounds.max += step;
    if (dice == 50) proxy.motion_type = static_cast<MotionType>(random() % kNumMotionTypes);
    if (dice == 51) proxy.filter_self = random() % 8;
  }
  life.update(tasks);
  life.check();
}

TEST(TreeBroadphase, findsThePairsOfBruteForceAndSweepThroughARandomLife) {
  for (uint32_t seed = 0; seed < 6; ++seed) {
    Life life(seed, seed % 2 == 0 ? 6.0f : 20.0f);
    for (int step = 0; step < 250; ++step) {
      live(life, nullptr);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(life.pairs_seen, 1000u);
    EXPECT_GT(life.resting_seen, 100u);
  }
}

TEST(TreeBroadphase, findsTheSamePairsForAnyNumberOfWorkers) {
  for (int workers : {2, 4}) {
    TaskManager tasks(workers, Sharing::Always);
    Life life(9, 6.0f);
    for (int step = 0; step < 100; ++step) {
      live(life, &tasks);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(TreeBroadphase, copesWithManyBodiesAtOnce) {
  Life life(11, 25.0f);
  std::vector<BroadphaseProxy> proxies;
  for (uint32_t body = 0; body < 2000; ++body) proxies.push_back(life.randomProxy(body));
  life.rest(proxies);
  life.update(nullptr);
  life.check();
  for (uint32_t body = 0; body < 2000; body += 2) life.awake.insert(body);  // half of them wake
  life.update(nullptr);
  life.check();
  for (int step = 0; step < 10; ++step) {
    for (uint32_t body : life.awake) {
      const Vec3 move = randomVector(life.random, -0.3f, 0.3f);
      life.all[body].bounds.min += move, life.all[body].bounds.max += move;
    }
    life.update(nullptr);
    life.check();
  }
  life.awake.clear();  // and all fall asleep
  life.update(nullptr);
  life.check();
  EXPECT_TRUE(life.tree.activePairs().empty());
  EXPECT_EQ(life.tree.activeTree().size(), 0u);
}

TEST(TreeBroadphase, takesRepeatedProxiesAtTheirLastWord) {
  Life life(12, 3.0f);
  std::vector<BroadphaseProxy> proxies;
  for (uint32_t i = 0; i < 200; ++i) proxies.push_back(life.randomProxy(i % 50));
  life.rest(proxies);
  life.update(nullptr);
  life.check();
  EXPECT_EQ(life.tree.size(), 50u);
}

TEST(TreeBroadphase, ignoresBoundsThatAreNotNumbersUntilTheyAre) {
  Life life(13, 3.0f);
  for (uint32_t body = 0; body < 60; ++body) {
    life.all[body] = life.randomProxy(body);
    life.awake.insert(body);
  }
  life.update(nullptr);
  life.check();
  const auto sound = life.all;
  for (uint32_t body = 0; body < 60; body += 3) life.all[body].bounds.min[body % 2] = NAN;
  life.update(nullptr);
  EXPECT_EQ(keys(life.tree.pairs()), keys(bruteForcePairs(life.list())));
  for (uint32_t body = 0; body < 60; body += 6) life.awake.erase(body);  // some rest so
  life.update(nullptr);
  EXPECT_EQ(keys(life.tree.pairs()), keys(bruteForcePairs(life.list())));
  life.all = sound;
  for (uint32_t body = 0; body < 60; ++body) life.awake.insert(body);
  life.update(nullptr);
  life.check();
}

TEST(TreeBroadphase, meetsBodiesWithoutEnd) {
  Life life(14, 3.0f);
  constexpr float kInf = INFINITY;
  for (uint32_t body = 0; body < 40; ++body) life.all[body] = life.randomProxy(body), life.awake.insert(body);
  BroadphaseProxy plane;
  plane.body = 40;
  plane.motion_type = MotionType::Fixed;
  plane.bounds = {Vec3(-kInf, -kInf, -kInf), Vec3(kInf, 0.0f, kInf)};
  life.rest({plane});
  life.all[41] = plane;
  life.all[41].body = 41;
  life.all[41].motion_type = MotionType::Keyframe;
  life.awake.insert(41);
  for (int step = 0; step < 3; ++step) {
    life.update(nullptr);
    life.check();
  }
}

TEST(TreeBroadphase, refusesActiveProxiesThatAreNotAscending) {
  TreeBroadphase tree;
  std::vector<BroadphaseProxy> proxies(2);
  EXPECT_EQ(tree.update(proxies), Error::OutOfRange);  // body 0 twice
  proxies[0].body = 1u << 31;
  EXPECT_EQ(tree.update(std::span(proxies).first(1)), Error::OutOfRange);
  EXPECT_EQ(tree.rest(std::span(proxies).first(1)), Error::OutOfRange);
  EXPECT_EQ(tree.size(), 0u);
  tree.remove(7);
  EXPECT_EQ(tree.update({}), Error::Ok);
}

TEST(TreeBroadphase, leavesTheTreesAloneWhileBodiesStayInTheirMargins) {
  Life life(15, 10.0f);
  for (uint32_t body = 0; body < 500; ++body) {
    life.all[body] = life.randomProxy(body);
    life.all[body].motion_type = MotionType::Active;
    life.awake.insert(body);
  }
  life.update(nullptr);
  Aabb before = life.tree.activeTree().bounds();
  for (auto& [body, proxy] : life.all) proxy.bounds.min.array() += 1e-4f, proxy.bounds.max.array() += 1e-4f;
  life.update(nullptr);
  life.check();
  const Aabb after = life.tree.activeTree().bounds();
  EXPECT_TRUE(before.min == after.min && before.max == after.max);
}

TEST(TreeBroadphase, queriesGiveExactBounds) {
  Life life(16, 8.0f);
  for (uint32_t body = 0; body < 600; ++body) {
    life.all[body] = life.randomProxy(body);
    if (body % 2 == 0) {
      life.awake.insert(body);
    } else {
      life.rest({life.all[body]});
    }
  }
  life.update(nullptr);
  for (int i = 0; i < 50; ++i) {
    const BroadphaseProxy query = life.randomProxy(0);
    std::set<uint32_t> found, expected;
    life.tree.overlap(query.bounds, [&](uint32_t body) { EXPECT_TRUE(found.insert(body).second); });
    for (const auto& [body, proxy] : life.all) {
      if (proxy.bounds.overlaps(query.bounds)) expected.insert(body);
    }
    EXPECT_EQ(found, expected);

    std::set<uint32_t> met;
    const TreeRay ray{.origin = query.bounds.center(), .motion = randomVector(life.random, -5.0f, 5.0f)};
    life.tree.castRay(ray, [&](uint32_t body, float fraction) {
      met.insert(body);
      return fraction;
    });
    for (const auto& [body, proxy] : life.all) {
      EXPECT_TRUE(!proxy.bounds.overlaps({ray.origin, ray.origin}) || met.contains(body));
    }
  }
}

}  // namespace
}  // namespace pfx
