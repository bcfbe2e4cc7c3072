// The dynamic tree against lists: queries, upkeep, height.
#include "pfx/low_level/broadphase/dynamic_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/unit/low_level/broadphase/random_proxies.h"

namespace pfx {
namespace {

Aabb randomBox(std::mt19937& random, float extent, float size) {
  const Vec3 center = randomVector(random, -extent, extent);
  const Vec3 half = randomVector(random, 0.01f, size);
  return {center - half, center + half};
}

// A tree beside the list that it stands for.
struct TreeAndList {
  DynamicTree tree;
  std::vector<DynamicTree::Location> locations;
  std::map<uint32_t, Aabb> list;

  explicit TreeAndList(uint32_t max_id) : locations(max_id, DynamicTree::kNowhere) {}

  void build(const std::vector<TreeLeaf>& leaves) {
    list.clear();
    for (const TreeLeaf& leaf : leaves) list[leaf.id] = leaf.bounds;
    auto shuffled = leaves;
    tree.build(shuffled, locations);
  }
  void insert(uint32_t id, const Aabb& box) {
    list[id] = box;
    tree.insert({box, id}, locations);
  }
  void remove(uint32_t id) {
    list.erase(id);
    tree.remove(locations[id], locations);
  }
  std::vector<uint32_t> query(const Aabb& box) const {
    std::vector<uint32_t> ids;
    tree.overlap(box, [&](uint32_t id) { ids.push_back(id); });
    std::sort(ids.begin(), ids.end());
    return ids;
  }
  std::vector<uint32_t> expected(const Aabb& box) const {
    std::vector<uint32_t> ids;
    for (const auto& [id, bounds] : list) {
      if (bounds.overlaps(box)) ids.push_back(id);
    }
    return ids;
  }
  void check(std::mt19937& random, float extent) const {
    ASSERT_EQ(tree.size(), list.size());
    Aabb all;
    for (const auto& [id, bounds] : list) {
      all.extend(bounds);
      const Aabb stored = tree.boundsAt(locations[id]);
      ASSERT_TRUE(stored.min == bounds.min && stored.max == bounds.max);
    }
    ASSERT_TRUE(tree.bounds().min == all.min && tree.bounds().max == all.max);
    ASSERT_LE(tree.height(), DynamicTree::maxHeight(2 * tree.size()));
    for (int i = 0; i < 20; ++i) {
      const Aabb box = randomBox(random, extent, i % 2 == 0 ? 0.5f : 5.0f);
      ASSERT_EQ(query(box), expected(box));
    }
  }
};

TEST(DynamicTree, findsWhatAListFindsAfterABulkBuildOfAnySize) {
  std::mt19937 random(1);
  for (uint32_t count :
       {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 15u, 16u, 17u, 31u, 33u, 63u, 65u, 100u, 1000u, 4097u}) {
    TreeAndList t(count);
    std::vector<TreeLeaf> leaves;
    for (uint32_t i = 0; i < count; ++i) leaves.push_back({randomBox(random, 10.0f, 1.0f), i});
    t.build(leaves);
    t.check(random, 10.0f);
  }
}

TEST(DynamicTree, staysSoundThroughInsertionsRemovalsAndRebuilds) {
  std::mt19937 random(2);
  constexpr uint32_t kIds = 400;
  TreeAndList t(kIds);
  for (int step = 0; step < 6000; ++step) {
    const uint32_t id = random() % kIds;
    // Seasons of growth and of decline, down to nothing.
    const bool growing = step / 1000 % 2 == 0;
    if (t.list.contains(id)) {
      if (!growing || random() % 4 == 0) t.remove(id);
    } else if (growing || random() % 4 == 0) {
      t.insert(id, randomBox(random, 10.0f, random() % 30 == 0 ? 20.0f : 1.0f));
    }
    if (step % 100 == 0) t.check(random, 10.0f);
  }
  while (!t.list.empty()) t.remove(t.list.begin()->first);
  t.check(random, 10.0f);
  t.insert(3, randomBox(random, 10.0f, 1.0f));
  t.check(random, 10.0f);
}

TEST(DynamicTree, staysFlatWhenLeavesComeInTheWorstOrder) {
  constexpr uint32_t kCount = 20000;
  std::mt19937 random(3);
  for (int order = 0; order < 4; ++order) {
    TreeAndList t(kCount);
    uint32_t highest = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
      const float x = static_cast<float>(i);
      Vec3 at = Vec3::Zero();                                  // all in one place
      if (order == 1) at = Vec3(x, 0, 0);                      // along a line
      if (order == 2) at = Vec3(i % 2 == 0 ? x : -x, 0, 0);    // outwards
      if (order == 3) at = Vec3(std::exp2(x * 0.005f), 0, 0);  // ever farther apart
      t.insert(i, {at - Vec3::Constant(0.4f), at + Vec3::Constant(0.4f)});
      if (i % 500 == 0) highest = std::max(highest, t.tree.height());
    }
    EXPECT_LE(highest, DynamicTree::maxHeight(2 * kCount)) << order;
    EXPECT_LT(highest, 22u) << order;
    t.check(random, 10.0f);
  }
}

TEST(DynamicTree, buildsAFlatTreeFromHostileLeaves) {
  for (int kind = 0; kind < 3; ++kind) {
    std::vector<TreeLeaf> leaves;
    for (uint32_t i = 0; i < 30000; ++i) {
      // The first cut of an exponential row splits off a single leaf, the next one again, and so on.
      const float x = kind == 0   ? 0.0f
                      : kind == 1 ? std::exp2(static_cast<float>(i) * 0.004f)
                                  : 1e38f * (i % 2);
      leaves.push_back({{Vec3(x, 0, 0), Vec3(x, 1, 1)}, i});
    }
    TreeAndList t(30000);
    t.build(leaves);
    EXPECT_LE(t.tree.height(), DynamicTree::maxHeight(30000));
    std::mt19937 random(4);
    t.check(random, 10.0f);
  }
}

TEST(DynamicTree, needsFewBytesALeaf) {
  std::mt19937 random(5);
  std::vector<TreeLeaf> leaves;
  for (uint32_t i = 0; i < 20000; ++i) leaves.push_back({randomBox(random, 100.0f, 1.0f), i});
  TreeAndList t(20000);
  t.build(leaves);
  EXPECT_LE(t.tree.memoryBytes(), 20000u * 56);
}

// Where a ray enters a box, or more than 1 when it misses; in double, by the definition.
double enterFraction(const TreeRay& ray, const Aabb& box) {
  double enter = 0.0, leave = ray.max_fraction;
  for (int k = 0; k < 3; ++k) {
    const double low = double{box.min[k]} - ray.half_extent[k] - ray.origin[k];
    const double high = double{box.max[k]} + ray.half_extent[k] - ray.origin[k];
    const double d = ray.motion[k];
    if (d == 0.0) {
      if (low > 0.0 || high < 0.0) return 2.0;
      continue;
    }
    enter = std::max(enter, std::min(low / d, high / d));
    leave = std::min(leave, std::max(low / d, high / d));
  }
  return enter <= leave ? enter : 2.0;
}

TEST(DynamicTree, raysAndSweptBoxesMeetTheBoxesThatAListMeets) {
  std::mt19937 random(6);
  std::vector<TreeLeaf> leaves;
  for (uint32_t i = 0; i < 2000; ++i) leaves.push_back({randomBox(random, 20.0f, 1.0f), i});
  TreeAndList t(2000);
  t.build(leaves);
  std::size_t hits = 0;
  for (int i = 0; i < 500; ++i) {
    TreeRay ray;
    ray.origin = randomVector(random, -25.0f, 25.0f);
    ray.motion = randomVector(random, -40.0f, 40.0f);
    if (i % 5 == 0) ray.motion[i % 3] = 0.0f;
    if (i % 7 == 0) ray.motion = Vec3::Unit(i % 3) * 30.0f;
    if (i % 3 == 0) ray.half_extent = randomVector(random, 0.0f, 2.0f);
    std::vector<uint32_t> found;
    t.tree.castRay(ray, [&](uint32_t id, float fraction) {
      found.push_back(id);
      return fraction;
    });
    std::sort(found.begin(), found.end());
    double nearest = 2.0;
    for (const TreeLeaf& leaf : leaves) {
      const double enter = enterFraction(ray, leaf.bounds);
      nearest = std::min(nearest, enter);
      const bool was_found = std::binary_search(found.begin(), found.end(), leaf.id);
      if (enter <= 1.0) {
        ++hits;
        ASSERT_TRUE(was_found);  // never misses
      } else if (was_found) {
        // A false hit is possible within rounding only: the box a little larger is met.
        ASSERT_LE(enterFraction(ray, leaf.bounds.grown(1e-4f)), 1.001);
      }
    }
    // The nearest entry, with each hit cutting the ray short.
    float best = 2.0f;
    t.tree.castRay(ray, [&](uint32_t id, float fraction) {
      const double enter = enterFraction(ray, leaves[id].bounds);
      if (enter < best) best = static_cast<float>(enter);
      return std::min(fraction, best);
    });
    ASSERT_EQ(best, static_cast<float>(nearest));
  }
  EXPECT_GT(hits, 1000u);
}

TEST(DynamicTree, stopsARayWhenToldTo) {
  TreeAndList t(10);
  for (uint32_t i = 0; i < 10; ++i) t.insert(i, {Vec3(static_cast<float>(i), 0, 0), Vec3(i + 0.5f, 1, 1)});
  std::vector<uint32_t> met;
  t.tree.castRay({.origin = Vec3(-1, 0.5f, 0.5f), .motion = Vec3(20, 0, 0)}, [&](uint32_t id, float) {
    met.push_back(id);
    return 0.0f;
  });
  EXPECT_EQ(met, std::vector<uint32_t>{0});
}

}  // namespace
}  // namespace pfx
