// A bounding-volume tree whose leaves come and go.
//
//   - Nodes have four children, whose bounds lie in rows of four, so that one test covers them all. A leaf
//   takes a slot
//     of its parent and no node of its own: about 45 bytes a leaf when built at once.
//   - build() splits by the surface-area heuristic over bins (I. Wald, On fast construction of SAH-based
//   bounding volume
//     hierarchies, 2007), small ranges exactly.
//   - insert() goes down where the surface grows least. When a leaf ends up too deep, the lowest ancestor
//   that is out of
//     balance is built anew (I. Galperin and R. Rivest, Scapegoat trees, 1993): the height stays bounded
//     whatever the order of the insertions, at an amortised cost of O(log n).
//   - The same calls in the same order give the same tree on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/aabb.h"

namespace pfx {

// A leaf: its bounds and a number that means something to the owner of the tree.
struct TreeLeaf {
  Aabb bounds;      // m; not empty, no NaN
  uint32_t id = 0;  // < 2^31
};

// A ray, or a box that is swept without turning: origin + fraction * motion.
struct TreeRay {
  Vec3 origin = Vec3::Zero();       // m
  Vec3 motion = Vec3::Zero();       // m, at fraction 1
  Vec3 half_extent = Vec3::Zero();  // m, of the swept box
  float max_fraction = 1.0f;
};

class DynamicTree {
 public:
  // Where a leaf is: node * 4 + slot.
  using Location = uint32_t;
  static constexpr Location kNowhere = 0xffffffffu;

  // `locations`, by id, is told where leaves are whenever they move; it belongs to the owner, who makes it
  // large enough for every id in the tree before the call. Other entries are not touched.
  void build(std::span<TreeLeaf> leaves, std::span<Location> locations);  // changes the order of `leaves`
  void insert(const TreeLeaf& leaf, std::span<Location> locations);
  void remove(Location at, std::span<Location> locations);
  void clear();

  // Cheaper than removal and insertion when many leaves move by little: setBounds for each of them, then
  // refit once, before any query. The tree keeps its shape, which fits less and less well until it is built
  // anew.
  void setBounds(Location at, const Aabb& box);
  void refit();

  uint32_t size() const { return num_leaves_; }
  uint32_t height() const;                     // nodes on the longest way down; at most maxHeight(2 * size())
  static uint32_t maxHeight(uint32_t leaves);  // about 1.5 log4(leaves) + 5
  std::size_t memoryBytes() const;
  Aabb bounds() const;  // of everything; empty when there is nothing
  Aabb boundsAt(Location at) const { return slotBounds(nodes_[at >> 2], at & 3); }

  // Calls fn(bounds, level, is_leaf) for every box in the tree, from the root (level 0) down.
  template <class Fn>
  void visit(Fn&& fn) const;

  // Calls fn(id) for each leaf whose bounds overlap `box`.
  template <class Fn>
  void overlap(const Aabb& box, Fn&& fn) const;

  // Calls fraction = fn(id, fraction) for leaves whose bounds the ray meets before `fraction`, near ones
  // first as far as the tree allows. fn returns the fraction up to which the search goes on: what it was
  // given to go on, that of a hit to look only for nearer ones, 0 to stop.
  template <class Fn>
  void castRay(const TreeRay& ray, Fn&& fn) const;

 private:
  using Child = uint32_t;  // node index, or kLeaf | id
  static constexpr uint32_t kLeaf = 0x80000000u;
  static constexpr uint32_t kNoNode = 0xffffffffu;
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  // Slots 0 .. count - 1 are in use; the others have bounds that nothing overlaps.
  struct alignas(64) Node {
    float min[3][4];
    float max[3][4];
    Child child[4];
    Location parent;  // slot of the parent that refers to this node; kNowhere at the root
    uint32_t count;
    uint32_t unused[2];
  };
  static_assert(sizeof(Node) == 128);

  class Builder;

  static Aabb slotBounds(const Node& node, uint32_t slot) {
    return {Vec3(node.min[0][slot], node.min[1][slot], node.min[2][slot]),
            Vec3(node.max[0][slot], node.max[1][slot], node.max[2][slot])};
  }
  static void setSlot(Node& node, uint32_t slot, const Aabb& box, Child child);
  static void clearSlot(Node& node, uint32_t slot);
  static Aabb nodeBounds(const Node& node);
  static uint32_t overlapMask(const Node& node, const Aabb& box);
  struct RayLanes;
  static uint32_t rayMask(const Node& node, const RayLanes& ray, float max_fraction, float (&enter)[4]);

  uint32_t newNode(Location parent);
  void attach(Location at, const Aabb& box, Child child, std::span<Location> locations);
  Aabb refitNode(uint32_t node);
  void shrinkUpwards(uint32_t node);
  void collapse(uint32_t node, std::span<Location> locations);
  uint32_t descend(const Aabb& box, std::span<Location> locations, uint32_t* depth);
  void rebalanceAbove(uint32_t node, std::span<Location> locations);
  uint32_t countLeaves(uint32_t node) const;
  void collectLeaves(uint32_t node);  // appends to rebuilt_ and frees the nodes
  uint32_t rebuild(uint32_t node,
                   std::span<Location> locations);  // returns the new node, which has no parent yet

  uint32_t root_ = kNoNode;
  uint32_t num_leaves_ = 0;
  uint32_t largest_size_ = 0;  // since everything was last built at once
  Vector<Node> nodes_;
  Vector<uint32_t> free_nodes_;
  Vector<TreeLeaf> rebuilt_;  // scratch of rebuild()
};

}  // namespace pfx

#include "pfx/low_level/broadphase/dynamic_tree_query.h"
