// Builds a subtree of the dynamic tree from a list of leaves. Used by dynamic_tree.cpp alone.
#pragma once

#include <array>
#include <span>

#include "pfx/low_level/broadphase/dynamic_tree.h"

namespace pfx {

class DynamicTree::Builder {
 public:
  Builder(DynamicTree& tree, std::span<Location> locations) : tree_(tree), locations_(locations) {}

  // Returns the root of a new subtree, which has no parent yet. There is at least one leaf; their order
  // changes.
  uint32_t makeRoot(std::span<TreeLeaf> leaves);

  static uint32_t ceilLog4(uint32_t n);
  // What makeRoot keeps to: three levels more than a full tree.
  static uint32_t height(uint32_t leaves) { return ceilLog4(leaves) + 3; }

 private:
  struct Parts {
    std::array<std::span<TreeLeaf>, 4> part;
    uint32_t count = 0;
  };

  Aabb makeNode(std::span<TreeLeaf> leaves, Location parent, uint32_t levels, uint32_t* index);
  Parts divide(std::span<TreeLeaf> leaves, uint64_t capacity) const;

  DynamicTree& tree_;
  std::span<Location> locations_;
};

}  // namespace pfx
