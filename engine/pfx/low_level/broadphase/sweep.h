// Pair finding by a sorted sweep: proxies in the order of their lower bound along one axis, each compared
// with those that start before it ends. The other two axes are compared four proxies at a time.
//
// The best choice for some thousand bodies of similar size; it costs O(n log n) and what overlaps along the
// axis in every step, however little moves. Large or mostly static worlds are served by the dynamic tree,
// which gives the same pairs in the same order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/error.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/broadphase/proxy.h"
#include "pfx/low_level/sort/radix_sort.h"

namespace pfx {

class SweepBroadphase {
 public:
  // All pairs of proxies whose bounds overlap (touching counts) and that motion types and filters admit,
  // sorted by key, each once. `axis`: 0, 1 or 2, see axisOfLargestVariance. Valid until the next call.
  // Proxies with bounds that are not finite numbers or empty form no pair. No pair is lost: the buffers grow.
  std::span<const Pair> findPairs(std::span<const BroadphaseProxy> proxies, int axis,
                                  TaskManager* tasks = nullptr);

 private:
  // Bounds in sweep order, padded so that four can be read from any proxy.
  struct Lanes {
    Vector<float> min, max;
  };
  struct Entry {
    uint32_t key_value, index;
    uint32_t key() const { return key_value; }
  };

  void order(std::span<const BroadphaseProxy> proxies, int axis, TaskManager* tasks);
  void sweep(TaskRange range, Vector<Pair>& out) const;
  void collect(TaskManager* tasks);

  Vector<Entry> entries_, entries_work_;
  std::array<Lanes, 3> lanes_;  // the sweep axis first
  Vector<BroadphaseProxy> sorted_;
  Vector<Vector<Pair>> found_;  // by worker
  Vector<Pair> pairs_, pairs_work_;
};

// The same into a buffer of the caller. Error::OutOfMaxPairs when it is too small: nothing is written then,
// and num_pairs says how many there are, so that the call can be repeated with a larger buffer.
struct FindPairsResult {
  Error error = Error::Ok;
  uint32_t num_pairs = 0;
};
FindPairsResult findPairs(SweepBroadphase& sweep, std::span<const BroadphaseProxy> proxies, int axis,
                          std::span<Pair> out, TaskManager* tasks = nullptr);

}  // namespace pfx
