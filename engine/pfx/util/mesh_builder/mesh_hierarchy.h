// The hierarchy over the facets of a mesh while it is built: a binary tree by the surface area heuristic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// Bounds of one triangle and its number.
struct alignas(16) BuildItem {
  float lo[3];
  uint32_t id;
  float hi[3];
  float unused;
};

struct BinaryNode {
  Aabb bounds;
  uint32_t first = 0, count = 0;  // range of items
  uint32_t left = 0;              // children are left and left + 1; 0: a leaf
};

struct HierarchyOptions {
  int bins = 16;              // per axis; more finds better splits, slower
  bool all_axes = false;      // try three axes instead of the longest
  bool full_islands = false;  // split large ranges at multiples of 64 items only
};

// Sorts the items into leaf order and returns the tree; the first node is the root. Leaves hold 1 .. 4 items.
// Source: I. Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007 (binning).
std::vector<BinaryNode> buildHierarchy(std::span<BuildItem> items, const HierarchyOptions& options);

// First item of each island: the largest subtrees of at most 64 items, in order.
std::vector<uint32_t> cutIslands(const std::vector<BinaryNode>& tree);

// Links of the eight-wide tree that follows from the binary one: for each node its children. Parents come first.
std::vector<std::array<MeshChild, 8>> collapse(const std::vector<BinaryNode>& tree);

}  // namespace pfx
