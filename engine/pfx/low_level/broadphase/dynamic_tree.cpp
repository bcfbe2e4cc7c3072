// Upkeep of the dynamic tree: insertion, removal, balance. The bulk build has its own file.
#include "pfx/low_level/broadphase/dynamic_tree.h"

#include "pfx/low_level/broadphase/tree_builder.h"

namespace pfx {

namespace {

float halfArea(const Aabb& box) {
  const Vec3 d = box.max - box.min;
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

Aabb joined(Aabb a, const Aabb& b) {
  a.extend(b);
  return a;
}

}  // namespace

uint32_t DynamicTree::maxHeight(uint32_t leaves) {
  return Builder::height(leaves) + Builder::ceilLog4(leaves) / 2 + 2;
}

void DynamicTree::setSlot(Node& node, uint32_t slot, const Aabb& box, Child child) {
  for (int k = 0; k < 3; ++k) node.min[k][slot] = box.min[k], node.max[k][slot] = box.max[k];
  node.child[slot] = child;
}

void DynamicTree::clearSlot(Node& node, uint32_t slot) {
  setSlot(node, slot, {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)}, kNoNode);
}

Aabb DynamicTree::nodeBounds(const Node& node) {
  Aabb box = slotBounds(node, 0);
  for (uint32_t i = 1; i < node.count; ++i) box.extend(slotBounds(node, i));
  return box;
}

Aabb DynamicTree::bounds() const { return root_ == kNoNode ? Aabb{} : nodeBounds(nodes_[root_]); }

uint32_t DynamicTree::newNode(Location parent) {
  uint32_t index = static_cast<uint32_t>(nodes_.size());
  if (free_nodes_.empty()) {
    nodes_.emplace_back();
  } else {
    index = free_nodes_.back();
    free_nodes_.pop_back();
  }
  Node& node = nodes_[index];
  for (uint32_t slot = 0; slot < 4; ++slot) clearSlot(node, slot);
  node.parent = parent;
  node.count = 0;
  node.unused[0] = node.unused[1] = 0;
  return index;
}

// Puts a child into a slot and tells the child where it is.
void DynamicTree::attach(Location at, const Aabb& box, Child child, std::span<Location> locations) {
  setSlot(nodes_[at >> 2], at & 3, box, child);
  if (child & kLeaf) {
    locations[child & ~kLeaf] = at;
  } else {
    nodes_[child].parent = at;
  }
}

void DynamicTree::clear() {
  root_ = kNoNode;
  num_leaves_ = largest_size_ = 0;
  nodes_.clear();
  free_nodes_.clear();
}

void DynamicTree::build(std::span<TreeLeaf> leaves, std::span<Location> locations) {
  clear();
  if (leaves.empty()) return;
  nodes_.reserve(leaves.size() * 3 / 8 + 1);
  num_leaves_ = largest_size_ = static_cast<uint32_t>(leaves.size());
  root_ = Builder(*this, locations).makeRoot(leaves);
}

// Finds a node with room for `box`, making one if need be, and grows the bounds on the way down.
uint32_t DynamicTree::descend(const Aabb& box, std::span<Location> locations, uint32_t* depth) {
  const float own = halfArea(box);
  uint32_t index = root_;
  for (*depth = 1;; ++*depth) {
    Node& node = nodes_[index];
    uint32_t best = 0;
    float best_growth = kInfinity;
    for (uint32_t slot = 0; slot < node.count; ++slot) {
      const Aabb child = slotBounds(node, slot);
      const float growth = halfArea(joined(child, box)) - halfArea(child);
      if (growth < best_growth) best = slot, best_growth = growth;
    }
    // A slot that is free costs nothing; going down costs what the child grows by.
    const bool room = node.count < 4;
    const bool is_leaf = (node.child[best] & kLeaf) != 0;
    if (room && (node.count == 0 || is_leaf || best_growth > own)) return index;

    const Aabb child_box = slotBounds(node, best);
    const Location at = index << 2 | best;
    if (is_leaf) {
      const Child leaf = node.child[best];
      const uint32_t inner = newNode(at);  // `node` may be invalid from here on
      nodes_[inner].count = 1;
      attach(inner << 2, child_box, leaf, locations);
      attach(at, joined(child_box, box), inner, locations);
      ++*depth;
      return inner;
    }
    setSlot(node, best, joined(child_box, box), node.child[best]);
    index = node.child[best];
  }
}

void DynamicTree::insert(const TreeLeaf& leaf, std::span<Location> locations) {
  if (root_ == kNoNode) root_ = newNode(kNowhere);
  uint32_t depth = 0;
  const uint32_t node = descend(leaf.bounds, locations, &depth);
  attach(node << 2 | nodes_[node].count++, leaf.bounds, kLeaf | leaf.id, locations);
  largest_size_ = std::max(largest_size_, ++num_leaves_);
  if (depth > maxHeight(largest_size_)) rebalanceAbove(node, locations);
}

uint32_t DynamicTree::countLeaves(uint32_t index) const {
  const Node& node = nodes_[index];
  uint32_t count = 0;
  for (uint32_t slot = 0; slot < node.count; ++slot) {
    count += node.child[slot] & kLeaf ? 1 : countLeaves(node.child[slot]);
  }
  return count;
}

// Builds anew the lowest ancestor that is higher than its number of leaves allows. There is one: the root is.
void DynamicTree::rebalanceAbove(uint32_t index, std::span<Location> locations) {
  uint32_t height = 1, leaves = countLeaves(index);
  while (height <= maxHeight(leaves) && nodes_[index].parent != kNowhere) {
    const Location at = nodes_[index].parent;
    index = at >> 2;
    ++height;
    const Node& node = nodes_[index];
    for (uint32_t slot = 0; slot < node.count; ++slot) {
      if (slot != (at & 3)) leaves += node.child[slot] & kLeaf ? 1 : countLeaves(node.child[slot]);
    }
  }
  const Location parent = nodes_[index].parent;
  const uint32_t fresh = rebuild(index, locations);
  if (parent == kNowhere) {
    root_ = fresh;
  } else {
    attach(parent, nodeBounds(nodes_[fresh]), fresh, locations);
  }
}

void DynamicTree::collectLeaves(uint32_t index) {
  const Node node = nodes_[index];
  free_nodes_.push_back(index);
  for (uint32_t slot = 0; slot < node.count; ++slot) {
    if (node.child[slot] & kLeaf) {
      rebuilt_.push_back({slotBounds(node, slot), node.child[slot] & ~kLeaf});
    } else {
      collectLeaves(node.child[slot]);
    }
  }
}

uint32_t DynamicTree::rebuild(uint32_t index, std::span<Location> locations) {
  rebuilt_.clear();
  collectLeaves(index);
  return Builder(*this, locations).makeRoot(rebuilt_);
}

void DynamicTree::shrinkUpwards(uint32_t index) {
  while (nodes_[index].parent != kNowhere) {
    const Aabb box = nodeBounds(nodes_[index]);
    const Location at = nodes_[index].parent;
    Node& parent = nodes_[at >> 2];
    const Aabb old = slotBounds(parent, at & 3);
    if (old.min == box.min && old.max == box.max) return;
    setSlot(parent, at & 3, box, index);
    index = at >> 2;
  }
}

// Replaces a node that has a single child by that child.
void DynamicTree::collapse(uint32_t index, std::span<Location> locations) {
  const Node node = nodes_[index];
  free_nodes_.push_back(index);
  if (node.parent == kNowhere) {
    root_ = node.child[0];
    nodes_[root_].parent = kNowhere;
    return;
  }
  attach(node.parent, slotBounds(node, 0), node.child[0], locations);
  shrinkUpwards(node.parent >> 2);
}

void DynamicTree::remove(Location at, std::span<Location> locations) {
  const uint32_t index = at >> 2, slot = at & 3;
  Node& node = nodes_[index];
  locations[node.child[slot] & ~kLeaf] = kNowhere;
  const uint32_t last = --node.count;
  if (slot != last) attach(at, slotBounds(node, last), node.child[last], locations);
  clearSlot(node, last);
  --num_leaves_;

  const bool is_root = node.parent == kNowhere;
  if (num_leaves_ == 0) {
    clear();
  } else if (num_leaves_ < largest_size_ / 2) {
    largest_size_ = num_leaves_;
    root_ = rebuild(root_, locations);
  } else if (last == 1 && (!is_root || !(node.child[0] & kLeaf))) {
    collapse(index, locations);
  } else {
    shrinkUpwards(index);
  }
}

void DynamicTree::setBounds(Location at, const Aabb& box) {
  Node& node = nodes_[at >> 2];
  setSlot(node, at & 3, box, node.child[at & 3]);
}

Aabb DynamicTree::refitNode(uint32_t index) {
  Node& node = nodes_[index];
  for (uint32_t slot = 0; slot < node.count; ++slot) {
    const Child child = node.child[slot];
    if (!(child & kLeaf)) setSlot(node, slot, refitNode(child), child);
  }
  return nodeBounds(node);
}

void DynamicTree::refit() {
  if (root_ != kNoNode) refitNode(root_);
}

uint32_t DynamicTree::height() const {
  if (root_ == kNoNode) return 0;
  struct Entry {
    uint32_t node, depth;
  };
  Vector<Entry> stack = {{root_, 1}};
  uint32_t deepest = 0;
  while (!stack.empty()) {
    const auto [index, depth] = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, depth);
    for (uint32_t slot = 0; slot < nodes_[index].count; ++slot) {
      const Child child = nodes_[index].child[slot];
      if (!(child & kLeaf)) stack.push_back({child, depth + 1});
    }
  }
  return deepest;
}

std::size_t DynamicTree::memoryBytes() const {
  return nodes_.capacity() * sizeof(Node) + free_nodes_.capacity() * sizeof(uint32_t) +
         rebuilt_.capacity() * sizeof(TreeLeaf);
}

}  // namespace pfx
