// Decomposition of pair lists against the set operations of the standard library.
#include "pfx/low_level/broadphase/decompose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>

#include "tests/unit/low_level/broadphase/random_proxies.h"

namespace pfx {
namespace {

std::vector<Pair> randomPairs(std::mt19937& random, uint32_t count, uint32_t first_contact) {
  std::map<uint64_t, Pair> sorted;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t a = random() % 12;
    const uint32_t b = a + 1 + random() % 12;
    const Pair pair{a, b, first_contact + i, i};
    sorted.emplace(pair.key(), pair);
  }
  std::vector<Pair> out;
  for (const auto& entry : sorted) out.push_back(entry.second);
  return out;
}

TEST(DecomposePairs, isSetArithmetic) {
  std::mt19937 random(4);
  PairChanges changes;
  for (int round = 0; round < 200; ++round) {
    const auto prev = randomPairs(random, random() % 80, 1000),
               cur = randomPairs(random, random() % 80, 5000);
    const auto p = keys(prev), c = keys(cur);
    std::vector<uint64_t> added, kept, removed;
    std::set_difference(c.begin(), c.end(), p.begin(), p.end(), std::back_inserter(added));
    std::set_intersection(c.begin(), c.end(), p.begin(), p.end(), std::back_inserter(kept));
    std::set_difference(p.begin(), p.end(), c.begin(), c.end(), std::back_inserter(removed));
    decomposePairs(prev, cur, changes);
    EXPECT_EQ(keys(changes.added), added);
    EXPECT_EQ(keys(changes.kept), kept);
    EXPECT_EQ(keys(changes.removed), removed);
    for (const Pair& pair : changes.kept) {
      const auto before =
          std::find_if(prev.begin(), prev.end(), [&](const Pair& x) { return x.key() == pair.key(); });
      EXPECT_EQ(pair.contact_id, before->contact_id);
      EXPECT_EQ(pair.flags, before->flags);
    }
    for (const Pair& pair : changes.removed) EXPECT_LT(pair.contact_id, 5000u);

    Vector<Pair> next;
    composePairs(changes.kept, changes.added, next);
    EXPECT_EQ(keys(next), c);
  }
}

}  // namespace
}  // namespace pfx
