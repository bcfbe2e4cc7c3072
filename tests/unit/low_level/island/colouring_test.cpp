// Colours: no dynamic body twice in one, nothing lost, contacts with the fixed world last.
#include "pfx/low_level/island/colouring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace pfx {
namespace {

struct Graph {
  std::vector<Link> links;
  std::vector<uint8_t> is_dynamic;

  bool dynamic(uint32_t body) const { return body < is_dynamic.size() && is_dynamic[body]; }
};

Graph randomGraph(uint32_t bodies, uint32_t links, uint32_t seed) {
  std::mt19937 random(seed);
  Graph g;
  for (uint32_t i = 0; i < bodies; ++i) g.is_dynamic.push_back(random() % 5 != 0);
  for (uint32_t i = 0; i < links; ++i) {
    const uint32_t a = random() % (bodies + 1);  // one past the end: a body that is not dynamic
    const uint32_t b = random() % bodies;
    g.links.push_back({a, b});
  }
  return g;
}

void expectValid(const Graph& g, const Colouring& colouring) {
  std::vector<int> seen(g.links.size(), 0);
  for (uint32_t c = 0; c < colouring.size(); ++c) {
    std::set<uint32_t> touched;
    const auto list = colouring.links(c);
    EXPECT_FALSE(list.empty());
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    for (uint32_t i : list) {
      ++seen[i];
      const auto [a, b] = g.links[i];
      EXPECT_TRUE(!g.dynamic(a) || touched.insert(a).second);
      EXPECT_TRUE(!g.dynamic(b) || b == a || touched.insert(b).second);
    }
  }
  for (uint32_t i : colouring.overflow()) ++seen[i];
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(g.links.size()));
}

TEST(Colouring, givesEveryLinkOneColourInWhichItsBodiesAppearOnce) {
  Colouring colouring;
  for (uint32_t round = 0; round < 30; ++round) {
    const Graph g = randomGraph(1 + 40 * round, 100 * round, round);
    colouring.build(g.links, g.is_dynamic);
    expectValid(g, colouring);
  }
}

TEST(Colouring, solvesContactsWithTheFixedWorldLast) {
  // A tower: ground - 0 - 1 - ... - 9, ground is body 10.
  Graph g{{}, std::vector<uint8_t>(11, 1)};
  g.is_dynamic[10] = 0;
  g.links.push_back({10, 0});
  for (uint32_t i = 0; i < 9; ++i) g.links.push_back({i, i + 1});
  Colouring colouring;
  colouring.build(g.links, g.is_dynamic);
  expectValid(g, colouring);
  ASSERT_EQ(colouring.size(), 3u);
  EXPECT_EQ(std::vector<uint32_t>(colouring.links(2).begin(), colouring.links(2).end()),
            (std::vector<uint32_t>{0}));
}

TEST(Colouring, listsWhatFindsNoColourAsOverflow) {
  // A plate on 400 boxes, all dynamic: one body in 400 links.
  Graph g{{}, std::vector<uint8_t>(401, 1)};
  for (uint32_t i = 1; i <= 400; ++i) g.links.push_back({0, i});
  Colouring colouring;
  colouring.build(g.links, g.is_dynamic);
  expectValid(g, colouring);
  EXPECT_EQ(colouring.size(), static_cast<uint32_t>(kMaxDynamicColours));
  EXPECT_EQ(colouring.overflow().size(), 400u - kMaxDynamicColours);
}

TEST(Colouring, putsLinksWithoutDynamicBodiesTogether) {
  const Graph g{{{0, 1}, {1, 2}, {0, 7}}, {0, 0, 0}};
  Colouring colouring;
  colouring.build(g.links, g.is_dynamic);
  ASSERT_EQ(colouring.size(), 1u);
  EXPECT_EQ(colouring.links(0).size(), 3u);
  colouring.build({}, {});
  EXPECT_EQ(colouring.size(), 0u);
  EXPECT_TRUE(colouring.overflow().empty());
}

TEST(Colouring, isTheSameWhenRepeated) {
  const Graph g = randomGraph(200, 900, 1);
  const Graph other = randomGraph(500, 3000, 2);
  Colouring used, fresh;
  used.build(other.links, other.is_dynamic);
  used.build(g.links, g.is_dynamic);
  fresh.build(g.links, g.is_dynamic);
  ASSERT_EQ(used.size(), fresh.size());
  for (uint32_t c = 0; c < used.size(); ++c) EXPECT_TRUE(std::ranges::equal(used.links(c), fresh.links(c)));
}

}  // namespace
}  // namespace pfx
