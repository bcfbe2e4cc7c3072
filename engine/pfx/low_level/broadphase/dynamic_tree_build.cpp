// Bulk build of the dynamic tree, by the surface-area heuristic.
//
// Node counts stay small because small ranges are cut at multiples of four, so that the lowest nodes are
// full. The height stays bounded because a subtree with h levels to go takes at most 4^h leaves, and a cut
// that would give a part more than that is replaced by the median.
#include <algorithm>
#include <bit>

#include "pfx/low_level/broadphase/tree_builder.h"

namespace pfx {

namespace {

constexpr uint32_t kBins = 16;
constexpr std::size_t kExactLimit = 32;  // leaves; ranges up to here are sorted and cut where it is best

// Bounds that grow by plain comparisons.
struct Box {
  float min[3], max[3];

  void add(const Aabb& b) {
    for (int k = 0; k < 3; ++k) min[k] = std::min(min[k], b.min[k]), max[k] = std::max(max[k], b.max[k]);
  }
  void add(const Box& b) {
    for (int k = 0; k < 3; ++k) min[k] = std::min(min[k], b.min[k]), max[k] = std::max(max[k], b.max[k]);
  }
  float halfArea() const {
    const float x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
    return x * y + y * z + z * x;
  }
};
constexpr float kHuge = 3e38f;
constexpr Box kEmpty = {{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};

// Twice the centre.
float centerOf(const TreeLeaf& leaf, int axis) { return leaf.bounds.min[axis] + leaf.bounds.max[axis]; }

struct Spread {
  int axis = 0;
  float min = 0.0f, size = 0.0f;  // of the centres along the axis
};

Spread longestAxis(std::span<const TreeLeaf> leaves) {
  Box centers = kEmpty;
  for (const TreeLeaf& leaf : leaves) {
    for (int k = 0; k < 3; ++k) {
      const float c = centerOf(leaf, k);
      centers.min[k] = std::min(centers.min[k], c);
      centers.max[k] = std::max(centers.max[k], c);
    }
  }
  Spread s;
  for (int k = 0; k < 3; ++k) {
    const float size = centers.max[k] - centers.min[k];
    if (k == 0 || size > s.size) s = {k, centers.min[k], size};
  }
  return s;
}

// A total order, so that the result does not depend on the algorithm that sorts.
auto before(int axis) {
  return [axis](const TreeLeaf& a, const TreeLeaf& b) {
    const float ca = centerOf(a, axis), cb = centerOf(b, axis);
    return ca < cb || (ca == cb && a.id < b.id);
  };
}

// Half, rounded up to a multiple of four: repeated, it fills 4^h leaves into h levels.
std::size_t medianCut(std::size_t n) { return std::min(((n + 1) / 2 + 3) / 4 * 4, n - 1); }

std::size_t cutAtMedian(std::span<TreeLeaf> leaves, int axis) {
  const std::size_t cut = medianCut(leaves.size());
  std::nth_element(leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(cut), leaves.end(),
                   before(axis));
  return cut;
}

// Sorts and cuts at the best multiple of four.
std::size_t cutExactly(std::span<TreeLeaf> leaves, int axis, uint64_t capacity) {
  std::sort(leaves.begin(), leaves.end(), before(axis));
  const std::size_t n = leaves.size();
  std::array<float, kExactLimit + 1> right_area;
  Box box = kEmpty;
  for (std::size_t i = n; i-- > 0;) {
    box.add(leaves[i].bounds);
    right_area[i] = box.halfArea();
  }
  box = kEmpty;
  std::size_t best = medianCut(n);
  float best_cost = kHuge;
  for (std::size_t i = 1; i < n; ++i) {
    box.add(leaves[i - 1].bounds);
    if (i % 4 != 0 || i > capacity || n - i > capacity) continue;
    const float cost = box.halfArea() * static_cast<float>(i) + right_area[i] * static_cast<float>(n - i);
    if (cost < best_cost) best = i, best_cost = cost;
  }
  return best;
}

struct Bins {
  std::array<Box, kBins> box;
  std::array<uint32_t, kBins> count{};
};

struct BinOf {
  Spread spread;
  float scale;
  explicit BinOf(const Spread& s) : spread(s), scale(static_cast<float>(kBins) / s.size) {}
  uint32_t operator()(const TreeLeaf& leaf) const {
    const float at = (centerOf(leaf, spread.axis) - spread.min) * scale;
    return std::min(static_cast<uint32_t>(at), kBins - 1);
  }
};

// The number of bins that go to the left, or 0 when no cut keeps both sides within the capacity.
uint32_t bestBin(const Bins& bins, uint64_t capacity) {
  std::array<float, kBins> right_cost;
  std::array<uint64_t, kBins> right_count;
  Box box = kEmpty;
  uint64_t count = 0;
  for (uint32_t b = kBins; b-- > 1;) {
    if (bins.count[b] > 0) box.add(bins.box[b]);
    count += bins.count[b];
    right_count[b] = count;
    right_cost[b] = count > 0 ? box.halfArea() * static_cast<float>(count) : 0.0f;
  }
  box = kEmpty;
  count = 0;
  uint32_t best = 0;
  float best_cost = kHuge;
  for (uint32_t b = 1; b < kBins; ++b) {
    if (bins.count[b - 1] > 0) box.add(bins.box[b - 1]);
    count += bins.count[b - 1];
    if (count == 0 || right_count[b] == 0 || count > capacity || right_count[b] > capacity) continue;
    const float cost = box.halfArea() * static_cast<float>(count) + right_cost[b];
    if (cost < best_cost) best = b, best_cost = cost;
  }
  return best;
}

std::size_t cutByBins(std::span<TreeLeaf> leaves, const Spread& spread, uint64_t capacity) {
  Bins bins;
  bins.box.fill(kEmpty);
  const BinOf bin_of(spread);
  for (const TreeLeaf& leaf : leaves) {
    const uint32_t b = bin_of(leaf);
    bins.box[b].add(leaf.bounds);
    ++bins.count[b];
  }
  const uint32_t cut_bin = bestBin(bins, capacity);
  if (cut_bin == 0) return cutAtMedian(leaves, spread.axis);
  std::size_t left = 0, right = leaves.size();
  while (left < right) {
    if (bin_of(leaves[left]) < cut_bin) {
      ++left;
    } else {
      std::swap(leaves[left], leaves[--right]);
    }
  }
  return left;
}

// Orders the leaves so that those before the returned place form one part and the others a second one,
// neither larger than the capacity if the median is not.
std::size_t cut(std::span<TreeLeaf> leaves, uint64_t capacity) {
  const Spread spread = longestAxis(leaves);
  if (leaves.size() <= kExactLimit) return cutExactly(leaves, spread.axis, capacity);
  // Centres in one place, or so far apart that their distance is no number.
  if (!(spread.size > 0.0f && spread.size < kHuge)) return cutAtMedian(leaves, spread.axis);
  return cutByBins(leaves, spread, capacity);
}

}  // namespace

uint32_t DynamicTree::Builder::ceilLog4(uint32_t n) {
  return n <= 1 ? n : (static_cast<uint32_t>(std::bit_width(n - 1)) + 1) / 2;
}

uint32_t DynamicTree::Builder::makeRoot(std::span<TreeLeaf> leaves) {
  uint32_t index = kNoNode;
  makeNode(leaves, kNowhere, height(static_cast<uint32_t>(leaves.size())), &index);
  return index;
}

// Up to four parts, none larger than the capacity of a child.
DynamicTree::Builder::Parts DynamicTree::Builder::divide(std::span<TreeLeaf> leaves,
                                                         uint64_t capacity) const {
  Parts parts;
  const auto add = [&](std::span<TreeLeaf> part) { parts.part[parts.count++] = part; };
  if (leaves.size() <= 4) {
    for (std::size_t i = 0; i < leaves.size(); ++i) add(leaves.subspan(i, 1));
    return parts;
  }
  add(leaves);
  while (parts.count < 4) {
    auto* largest = std::max_element(parts.part.begin(), parts.part.begin() + parts.count,
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (largest->size() <= 4) break;
    // Each side of the first cut is cut once more.
    const std::size_t at = cut(*largest, parts.count == 1 ? 2 * capacity : capacity);
    add(largest->subspan(at));
    *largest = largest->first(at);
  }
  // A small part whose leaves find room here needs no node of its own.
  auto* smallest = std::min_element(parts.part.begin(), parts.part.begin() + parts.count,
                                    [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (smallest->size() > 1 && parts.count - 1 + smallest->size() <= 4) {
    const std::span<TreeLeaf> dissolved = *smallest;
    *smallest = dissolved.first(1);
    for (std::size_t i = 1; i < dissolved.size(); ++i) add(dissolved.subspan(i, 1));
  }
  return parts;
}

Aabb DynamicTree::Builder::makeNode(std::span<TreeLeaf> leaves, Location parent, uint32_t levels,
                                    uint32_t* index) {
  const uint32_t node = *index = tree_.newNode(parent);
  const Parts parts = divide(leaves, uint64_t{1} << (2 * (levels - 1)));
  tree_.nodes_[node].count = parts.count;
  Aabb bounds = leaves[0].bounds;
  for (uint32_t slot = 0; slot < parts.count; ++slot) {
    const std::span<TreeLeaf> part = parts.part[slot];
    const Location at = node << 2 | slot;
    if (part.size() == 1) {
      tree_.attach(at, part[0].bounds, kLeaf | part[0].id, locations_);
      bounds.extend(part[0].bounds);
      continue;
    }
    uint32_t child = kNoNode;
    const Aabb box = makeNode(part, at, levels - 1, &child);
    tree_.attach(at, box, child, locations_);
    bounds.extend(box);
  }
  return bounds;
}

}  // namespace pfx
