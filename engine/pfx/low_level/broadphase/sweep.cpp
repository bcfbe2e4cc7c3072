// The sorted sweep, four proxies at a time.
#include "pfx/low_level/broadphase/sweep.h"

#include <algorithm>
#include <bit>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pfx {

namespace {

constexpr uint32_t kLanes = 4;
constexpr uint32_t kGrain = 128;  // proxies a block

// NaN compares false with everything: as padding it ends each sweep. Proxies without proper bounds become NaN
// too, and go behind all others, where they end a sweep no earlier than the padding would.
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr uint32_t kBehindAll = 0xffffffffu;

bool isBox(const Aabb& box) { return (box.min.array() <= box.max.array()).all(); }

// Bit k is set when start[k] <= limit: the bounds at k begin before the limit. NaN never does.
// overlapMask: bit k is set when [min[k], max[k]] and [low, high] overlap.
#if defined(__SSE2__)
uint32_t beginMask(const float* start, float limit) {
  return static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(_mm_loadu_ps(start), _mm_set1_ps(limit))));
}
uint32_t overlapMask(const float* min, const float* max, float low, float high) {
  const __m128 below = _mm_cmple_ps(_mm_loadu_ps(min), _mm_set1_ps(high));
  const __m128 above = _mm_cmple_ps(_mm_set1_ps(low), _mm_loadu_ps(max));
  return static_cast<uint32_t>(_mm_movemask_ps(_mm_and_ps(below, above)));
}
#else
uint32_t beginMask(const float* start, float limit) {
  uint32_t mask = 0;
  for (uint32_t k = 0; k < kLanes; ++k) mask |= uint32_t{start[k] <= limit} << k;
  return mask;
}
uint32_t overlapMask(const float* min, const float* max, float low, float high) {
  uint32_t mask = 0;
  for (uint32_t k = 0; k < kLanes; ++k) mask |= uint32_t{min[k] <= high && low <= max[k]} << k;
  return mask;
}
#endif

}  // namespace

void SweepBroadphase::order(std::span<const BroadphaseProxy> proxies, int axis, TaskManager* tasks) {
  const std::size_t n = proxies.size();
  entries_.resize(n);
  entries_work_.resize(n);
  for (uint32_t i = 0; i < n; ++i) {
    const Aabb& bounds = proxies[i].bounds;
    entries_[i] = {isBox(bounds) ? floatKey(bounds.min[axis]) : kBehindAll, i};
  }
  sort(std::span(entries_), std::span(entries_work_), tasks);

  sorted_.resize(n);
  const std::array<int, 3> axes = {axis, (axis + 1) % 3, (axis + 2) % 3};
  for (Lanes& lanes : lanes_) {
    lanes.min.resize(n + kLanes);
    lanes.max.resize(n + kLanes);
    // NaN compares false with everything, so the padding ends each sweep.
    std::fill_n(lanes.min.begin() + static_cast<std::ptrdiff_t>(n), kLanes,
                std::numeric_limits<float>::quiet_NaN());
    std::fill_n(lanes.max.begin() + static_cast<std::ptrdiff_t>(n), kLanes,
                std::numeric_limits<float>::quiet_NaN());
  }
  parallelFor(tasks, static_cast<uint32_t>(n), kGrain, [&](TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const BroadphaseProxy& proxy = proxies[entries_[i].index];
      const Aabb bounds =
          isBox(proxy.bounds) ? proxy.bounds : Aabb{Vec3::Constant(kNaN), Vec3::Constant(kNaN)};
      sorted_[i] = proxy;
      for (std::size_t k = 0; k < 3; ++k) {
        lanes_[k].min[i] = bounds.min[axes[k]];
        lanes_[k].max[i] = bounds.max[axes[k]];
      }
    }
  });
}

void SweepBroadphase::sweep(TaskRange range, Vector<Pair>& out) const {
  const auto& [a, b, c] = lanes_;
  for (uint32_t i = range.begin; i < range.end; ++i) {
    const BroadphaseProxy& proxy = sorted_[i];
    const float end = a.max[i];
    for (uint32_t j = i + 1;; j += kLanes) {
      const uint32_t begun = beginMask(&a.min[j], end);
      uint32_t hits = begun & overlapMask(&b.min[j], &b.max[j], b.min[i], b.max[i]) &
                      overlapMask(&c.min[j], &c.max[j], c.min[i], c.max[i]);
      for (; hits != 0; hits &= hits - 1) {
        const BroadphaseProxy& other = sorted_[j + static_cast<uint32_t>(std::countr_zero(hits))];
        if (!mayPair(proxy, other)) continue;
        out.push_back({std::min(proxy.body, other.body), std::max(proxy.body, other.body), kNoContact, 0});
      }
      if (begun != 0xf) break;
    }
  }
}

void SweepBroadphase::collect(TaskManager* tasks) {
  pairs_.clear();
  for (const Vector<Pair>& part : found_) pairs_.insert(pairs_.end(), part.begin(), part.end());
  pairs_work_.resize(pairs_.size());
  sort(std::span(pairs_), std::span(pairs_work_), tasks);
}

std::span<const Pair> SweepBroadphase::findPairs(std::span<const BroadphaseProxy> proxies, int axis,
                                                 TaskManager* tasks) {
  order(proxies, axis, tasks);
  found_.resize(static_cast<std::size_t>(numWorkers(tasks)));
  for (Vector<Pair>& part : found_) part.clear();
  parallelFor(tasks, static_cast<uint32_t>(proxies.size()), kGrain,
              [&](TaskRange range) { sweep(range, found_[range.worker]); });
  collect(tasks);
  return pairs_;
}

FindPairsResult findPairs(SweepBroadphase& sweep, std::span<const BroadphaseProxy> proxies, int axis,
                          std::span<Pair> out, TaskManager* tasks) {
  if (axis < 0 || axis > 2) return {.error = Error::OutOfRange};
  const std::span<const Pair> pairs = sweep.findPairs(proxies, axis, tasks);
  const uint32_t count = static_cast<uint32_t>(pairs.size());
  if (out.size() < pairs.size()) return {.error = Error::OutOfMaxPairs, .num_pairs = count};
  std::copy(pairs.begin(), pairs.end(), out.begin());
  return {.num_pairs = count};
}

}  // namespace pfx
