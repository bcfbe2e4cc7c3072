// Pair finding with bounding-volume trees, for worlds that are large or mostly at rest.
//
// Properties:
//   1. The same pairs in the same order as the sorted sweep: those whose exact bounds overlap, sorted by key.
//   2. What rests costs nothing per step. Resting proxies (fixed or asleep) lie in a tree of their own; only
//   proxies
//      that are passed to update() are looked at.
//   3. An active proxy has a leaf that is larger than the proxy: by a share of its size, and ahead by the way
//   it will go
//      in the next steps. Only a proxy that leaves its leaf changes the tree and searches it. The pairs of
//      leaves that were found stay in a sorted list, from which each step takes those whose exact bounds
//      overlap.
//   4. The result does not depend on the number of workers, nor on the shape of the trees.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/error.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/broadphase/dynamic_tree.h"
#include "pfx/low_level/broadphase/proxy.h"

namespace pfx {

// Leaves end where squares of coordinates would no longer be finite: bounds beyond meet at that wall, and the
// exact test sorts them out.
inline Aabb leafBounds(const Aabb& box) {
  const Vec3 far = Vec3::Constant(1e18f);  // m
  return {box.min.cwiseMax(-far).cwiseMin(far), box.max.cwiseMax(-far).cwiseMin(far)};
}

class TreeBroadphase {
 public:
  // Adds proxies that rest, or changes the bounds, filters or motion type of proxies and lets them rest. Many
  // at once are cheaper than one by one. Counts from the next update on. Bodies must be below 2^31
  // (Error::OutOfRange; nothing is done then).
  Error rest(std::span<const BroadphaseProxy> proxies);

  // Forgets a body; unknown bodies are ignored. Counts from the next update on.
  void remove(uint32_t body);

  // One step. `active` has the proxies of all bodies that may move, strictly ascending by body
  // (Error::OutOfRange otherwise; nothing is done then). Bodies that were active before and are missing rest
  // from now on where they are. Proxies with bounds that are not finite numbers or empty form no pair.
  Error update(std::span<const BroadphaseProxy> active, TaskManager* tasks = nullptr);

  // Of the last update, sorted by key. Active: at least one of the two bodies is active. Valid until the next
  // update.
  std::span<const Pair> activePairs() const { return active_pairs_; }
  std::span<const Pair> restingPairs() const { return resting_pairs_; }
  std::span<const Pair> pairs();  // both together

  bool contains(uint32_t body) const { return body < status_.size() && !(status_[body] & kGone); }
  const Aabb& bounds(uint32_t body) const { return bounds_[body]; }  // of a body that it contains
  uint32_t size() const;
  std::size_t memoryBytes() const;
  const DynamicTree& restingTree() const { return resting_tree_; }
  const DynamicTree& activeTree() const { return active_tree_; }

  // Calls fn(body) for each body whose bounds overlap `box`.
  template <class Fn>
  void overlap(const Aabb& box, Fn&& fn) const {
    const auto exact = [&](uint32_t body) {
      if (bounds_[body].overlaps(box)) fn(body);
    };
    resting_tree_.overlap(leafBounds(box), exact);
    active_tree_.overlap(leafBounds(box), exact);
  }

  // Calls fraction = fn(body, fraction) for the bodies that the ray may meet; see DynamicTree::castRay.
  template <class Fn>
  void castRay(TreeRay ray, Fn&& fn) const {
    bool stopped = false;
    resting_tree_.castRay(ray, [&](uint32_t body, float fraction) {
      ray.max_fraction = fn(body, fraction);
      stopped = ray.max_fraction <= 0.0f;
      return ray.max_fraction;
    });
    if (!stopped) active_tree_.castRay(ray, fn);
  }

 private:
  // What every pass over pairs asks of a body, in a byte: at home in one of the trees or gone, whether its
  // pairs have to be searched for, and its motion type above.
  enum Status : uint8_t { kGone = 1, kResting = 2, kActive = 4, kChanged = 8 };
  static constexpr int kTypeShift = 4;
  struct Record {
    uint32_t filter_self = 0, filter_target = 0;
    uint32_t stamp = 0;  // number of the last update that named the body
  };
  struct PairKey {
    uint64_t value;
    uint64_t key() const { return value; }
  };
  static PairKey pairKey(uint32_t a, uint32_t b) {
    return {a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a};
  }

  void grow(uint32_t num_bodies);
  MotionType typeOf(uint32_t body) const { return static_cast<MotionType>(status_[body] >> kTypeShift); }
  void settle(const BroadphaseProxy& proxy, Status home);
  bool isSettled(const BroadphaseProxy& proxy) const;
  void takeOut(uint32_t body);
  void addLeaves(DynamicTree& tree, Vector<TreeLeaf>& leaves);
  bool mayPair(uint32_t a, uint32_t b) const;

  void compareWithLeaves(std::span<const BroadphaseProxy> active, TaskManager* tasks);
  void restTheMissing(std::span<const BroadphaseProxy> active);
  void moveLeaves(std::span<const BroadphaseProxy> active);
  void rebuildActiveTree(std::span<const BroadphaseProxy> active);
  void search(TaskManager* tasks);
  void searchAround(uint32_t body, Vector<PairKey>& out) const;
  void updateCandidates();
  void updateRestingPairs();
  void selectOverlapping(TaskManager* tasks);

  // By body. `bounds_` are the exact ones; `locations_` are places in the tree of the home, or kNowhere for
  // bodies without proper bounds.
  Vector<uint8_t> status_;
  Vector<Record> records_;
  Vector<Aabb> bounds_;
  Vector<DynamicTree::Location> locations_;

  DynamicTree resting_tree_, active_tree_;
  uint32_t stamp_ = 0;
  uint32_t moved_since_build_ = 0;   // leaves of the active tree that were refitted
  uint32_t num_restless_ = 0;        // bodies in the resting tree that are not Fixed
  bool resting_changed_ = false;     // a resting body came or went since the last update
  Vector<uint32_t> active_;     // bodies of the last update
  Vector<uint32_t> fresh_;      // resting bodies whose pairs have to be searched for
  Vector<PairKey> candidates_;  // pairs of leaves that overlap, one or both active; sorted
  Vector<Pair> active_pairs_, resting_pairs_, all_pairs_;  // sorted

  // Scratch of a step.
  Vector<TreeLeaf> leaf_of_;  // by place in `active`: the new leaf, id kUnmoved when the old one stays
  Vector<uint32_t> moved_;    // bodies
  Vector<TreeLeaf> leaves_;
  Vector<Vector<PairKey>> found_by_worker_;
  Vector<PairKey> found_, work_, merged_, resting_found_;
  Vector<Pair> merged_pairs_;
  Vector<uint32_t> block_counts_;
};

}  // namespace pfx
