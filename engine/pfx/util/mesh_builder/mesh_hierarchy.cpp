// Binned splits, top down, in place.
#include "pfx/util/mesh_builder/mesh_hierarchy.h"

#include <emmintrin.h>

#include <algorithm>
#include <array>
#include <limits>

namespace pfx {
namespace {

constexpr int kMaxBins = 32;
constexpr int kMedianDepth = 32;  // below it ranges are halved by count, which bounds the depth of the tree

// Bounds with the fourth lane unused.
struct Box4 {
  __m128 lo = _mm_set1_ps(std::numeric_limits<float>::max());
  __m128 hi = _mm_set1_ps(-std::numeric_limits<float>::max());

  void extend(__m128 l, __m128 h) { lo = _mm_min_ps(lo, l), hi = _mm_max_ps(hi, h); }
  void extend(const Box4& b) { extend(b.lo, b.hi); }
  float halfArea() const {
    alignas(16) float d[4];
    _mm_store_ps(d, _mm_sub_ps(hi, lo));
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

__m128 loadLo(const BuildItem& i) { return _mm_load_ps(i.lo); }
__m128 loadHi(const BuildItem& i) { return _mm_load_ps(i.hi); }
float centroid2(const BuildItem& i, int axis) { return i.lo[axis] + i.hi[axis]; }

Aabb toAabb(const Box4& b) {
  alignas(16) float l[4], h[4];
  _mm_store_ps(l, b.lo);
  _mm_store_ps(h, b.hi);
  return {Vec3(l[0], l[1], l[2]), Vec3(h[0], h[1], h[2])};
}

struct Extents {
  Box4 bounds, centroids;  // centroids times two
};

Extents extents(std::span<const BuildItem> items) {
  Extents e;
  for (const BuildItem& item : items) {
    const __m128 l = loadLo(item), h = loadHi(item), c = _mm_add_ps(l, h);
    e.bounds.extend(l, h);
    e.centroids.extend(c, c);
  }
  return e;
}

// Maps centroids to bins along one axis.
struct BinMap {
  int axis;
  float origin, scale;
  int bins;
  int operator()(const BuildItem& i) const {
    return std::min(bins - 1, static_cast<int>((centroid2(i, axis) - origin) * scale));
  }
};

struct Split {
  float cost = std::numeric_limits<float>::max();
  BinMap map{0, 0.0f, 0.0f, 0};
  int bin = 0;         // first bin of the right side
  uint32_t left = 0;   // items on the left
};

// A leaf tests four triangles in the time of one, so that a range costs its blocks of four.
float blocks(uint32_t items) { return static_cast<float>((items + kMaxLeafFacets - 1) / kMaxLeafFacets); }

// The best border between two bins on one axis.
Split bestSplit(std::span<const BuildItem> items, const BinMap& map) {
  std::array<Box4, kMaxBins> box;
  std::array<uint32_t, kMaxBins> count{};
  for (const BuildItem& item : items) {
    const int b = map(item);
    box[b].extend(loadLo(item), loadHi(item));
    ++count[b];
  }
  std::array<float, kMaxBins> right_cost{};
  Box4 sum;
  uint32_t n = 0;
  for (int b = map.bins - 1; b > 0; --b) {
    sum.extend(box[b]);
    n += count[b];
    right_cost[b] = n == 0 ? 0.0f : sum.halfArea() * blocks(n);
  }
  Split best;
  sum = Box4();
  n = 0;
  for (int b = 1; b < map.bins; ++b) {
    sum.extend(box[b - 1]);
    n += count[b - 1];
    if (n == 0 || n == items.size()) continue;
    const float cost = sum.halfArea() * blocks(n) + right_cost[b];
    if (cost < best.cost) best = {cost, map, b, n};
  }
  return best;
}

// Moves the `left` items with the smallest centroids to the front.
void selectFront(std::span<BuildItem> items, uint32_t left, int axis) {
  std::nth_element(items.begin(), items.begin() + left, items.end(), [axis](const BuildItem& a, const BuildItem& b) {
    const float ca = centroid2(a, axis), cb = centroid2(b, axis);
    return ca != cb ? ca < cb : a.id < b.id;
  });
}

// Divides the items in two and returns the size of the first part.
uint32_t divide(std::span<BuildItem> items, const Box4& centroids, int depth, const HierarchyOptions& options) {
  alignas(16) float lo[4], size[4];
  _mm_store_ps(lo, centroids.lo);
  _mm_store_ps(size, _mm_sub_ps(centroids.hi, centroids.lo));
  const int longest = static_cast<int>(std::max_element(size, size + 3) - size);
  const uint32_t n = static_cast<uint32_t>(items.size());
  const bool whole_islands = options.full_islands && n > kMaxIslandFacets;

  Split best;
  if (depth < kMedianDepth) {
    const int bins = n < 32 ? std::min(8, options.bins) : std::min(options.bins, kMaxBins);
    for (int axis = 0; axis < 3; ++axis) {
      const float scale = static_cast<float>(bins) / size[axis];
      if ((axis != longest && !options.all_axes) || !(scale < std::numeric_limits<float>::max())) continue;
      const Split s = bestSplit(items, {axis, lo[axis], scale, bins});
      if (s.cost < best.cost) best = s;
    }
  }
  if (whole_islands) {
    const uint32_t islands = (n + kMaxIslandFacets - 1) / kMaxIslandFacets;
    const uint32_t wanted = best.left == 0 ? islands / 2 : (best.left + kMaxIslandFacets / 2) / kMaxIslandFacets;
    const uint32_t left = std::clamp(wanted, 1u, islands - 1) * kMaxIslandFacets;
    selectFront(items, left, best.left == 0 ? longest : best.map.axis);
    return left;
  }
  if (best.left == 0) {
    selectFront(items, n / 2, longest);
    return n / 2;
  }
  const auto middle =
      std::partition(items.begin(), items.end(), [&](const BuildItem& i) { return best.map(i) < best.bin; });
  return static_cast<uint32_t>(middle - items.begin());
}

}  // namespace

std::vector<BinaryNode> buildHierarchy(std::span<BuildItem> items, const HierarchyOptions& options) {
  std::vector<BinaryNode> tree;
  tree.reserve(items.size() + 2);
  tree.push_back({{}, 0, static_cast<uint32_t>(items.size()), 0});
  struct Open {
    uint32_t node;
    int depth;
  };
  std::vector<Open> stack{{0, 0}};
  while (!stack.empty()) {
    const Open open = stack.back();
    stack.pop_back();
    const uint32_t first = tree[open.node].first;
    const auto range = items.subspan(first, tree[open.node].count);
    const Extents e = extents(range);
    tree[open.node].bounds = toAabb(e.bounds);
    if (range.size() <= kMaxLeafFacets) continue;
    const uint32_t left_count = divide(range, e.centroids, open.depth, options);
    const uint32_t left = static_cast<uint32_t>(tree.size());
    tree[open.node].left = left;
    tree.push_back({{}, first, left_count, 0});
    tree.push_back({{}, first + left_count, static_cast<uint32_t>(range.size()) - left_count, 0});
    stack.push_back({left + 1, open.depth + 1});
    stack.push_back({left, open.depth + 1});
  }
  return tree;
}

std::vector<uint32_t> cutIslands(const std::vector<BinaryNode>& tree) {
  std::vector<uint32_t> firsts, stack{0};
  while (!stack.empty()) {
    const BinaryNode& node = tree[stack.back()];
    stack.pop_back();
    if (node.count <= kMaxIslandFacets) {
      firsts.push_back(node.first);
    } else {
      stack.push_back(node.left + 1);
      stack.push_back(node.left);
    }
  }
  return firsts;
}

}  // namespace pfx
