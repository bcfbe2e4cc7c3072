// The pairs of the tree broad phase: searching, keeping, selecting.
#include <algorithm>

#include "pfx/low_level/broadphase/tree_broadphase.h"
#include "pfx/low_level/sort/radix_sort.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pfx {

namespace {

constexpr uint32_t kSearchGrain = 64;    // bodies a block
constexpr uint32_t kSelectGrain = 4096;  // candidates a block

Pair toPair(uint64_t key) {
  return {static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key), kNoContact, 0};
}

#if defined(__SSE2__)
// Six comparisons in two registers: (min x, y, z, max x) and (min z, max x, y, z) of each box.
bool overlapFast(const Aabb& a, const Aabb& b) {
  static_assert(sizeof(Aabb) == 6 * sizeof(float));
  const float *pa = a.min.data(), *pb = b.min.data();
  const __m128 min_a = _mm_loadu_ps(pa), max_a = _mm_loadu_ps(pa + 2);
  const __m128 min_b = _mm_loadu_ps(pb), max_b = _mm_loadu_ps(pb + 2);
  // Shift the maxima into lanes 0 .. 2.
  const __m128 upper_a = _mm_shuffle_ps(max_a, max_a, _MM_SHUFFLE(3, 3, 2, 1));
  const __m128 upper_b = _mm_shuffle_ps(max_b, max_b, _MM_SHUFFLE(3, 3, 2, 1));
  const __m128 both = _mm_and_ps(_mm_cmple_ps(min_a, upper_b), _mm_cmple_ps(min_b, upper_a));
  return (_mm_movemask_ps(both) & 7) == 7;
}
#else
bool overlapFast(const Aabb& a, const Aabb& b) { return a.overlaps(b); }
#endif

}  // namespace

bool TreeBroadphase::mayPair(uint32_t a, uint32_t b) const {
  const Record &x = records_[a], &y = records_[b];
  return detectsCollision(typeOf(a), typeOf(b)) &&
         filtersMatch(x.filter_self, x.filter_target, y.filter_self, y.filter_target);
}

// Pairs of `body`, whose leaf is new, with all others. Two bodies that both changed find each other twice;
// the one with the lower index reports it.
void TreeBroadphase::searchAround(uint32_t body, Vector<PairKey>& out) const {
  if (locations_[body] == DynamicTree::kNowhere) return;
  const bool is_active = status_[body] & kActive;
  const Aabb box = (is_active ? active_tree_ : resting_tree_).boundsAt(locations_[body]);
  const auto report = [&](uint32_t other) {
    if (other > body || (other < body && !(status_[other] & kChanged))) {
      if (mayPair(body, other)) out.push_back(pairKey(body, other));
    }
  };
  active_tree_.overlap(box, report);
  // Fixed bodies meet nobody at rest when all that rests is fixed.
  if (is_active || typeOf(body) != MotionType::Fixed || num_restless_ > 0) resting_tree_.overlap(box, report);
}

void TreeBroadphase::search(TaskManager* tasks) {
  found_by_worker_.resize(static_cast<std::size_t>(numWorkers(tasks)));
  for (Vector<PairKey>& part : found_by_worker_) part.clear();
  const uint32_t num_moved = static_cast<uint32_t>(moved_.size());
  parallelFor(tasks, num_moved + static_cast<uint32_t>(fresh_.size()), kSearchGrain, [&](TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const uint32_t body = i < num_moved ? moved_[i] : fresh_[i - num_moved];
      // A resting body that was touched and then became active is in both lists.
      if (i >= num_moved && !(status_[body] & kResting)) continue;
      searchAround(body, found_by_worker_[range.worker]);
    }
  });
  found_.clear();
  resting_found_.clear();
  for (const Vector<PairKey>& part : found_by_worker_) {
    for (const PairKey& key : part) {
      const auto [a, b, contact, flags] = toPair(key.value);
      const bool active = (status_[a] | status_[b]) & kActive;
      if (active || overlapFast(bounds_[a], bounds_[b])) (active ? found_ : resting_found_).push_back(key);
    }
  }
  work_.resize(found_.size());
  sort(std::span(found_), std::span(work_), tasks);
}

// Keeps the candidates of leaves that stayed, hands over those that now rest, and adds those that were found.
void TreeBroadphase::updateCandidates() {
  if (moved_.empty() && fresh_.empty() && !resting_changed_) return;
  merged_.clear();
  auto next = found_.begin();
  for (const PairKey& key : candidates_) {
    const auto [a, b, contact, flags] = toPair(key.value);
    const int either = status_[a] | status_[b];
    if (either & (kChanged | kGone)) continue;
    if (!(either & kActive)) {
      if (overlapFast(bounds_[a], bounds_[b])) resting_found_.push_back(key);
      continue;
    }
    while (next != found_.end() && next->value < key.value) merged_.push_back(*next++);
    merged_.push_back(key);
  }
  merged_.insert(merged_.end(), next, found_.end());
  candidates_.swap(merged_);
}

void TreeBroadphase::updateRestingPairs() {
  if (!resting_changed_ && resting_found_.empty()) return;
  resting_changed_ = false;
  work_.resize(resting_found_.size());
  sort(std::span(resting_found_), std::span(work_));
  merged_pairs_.clear();
  auto next = resting_found_.begin();
  for (const Pair& pair : resting_pairs_) {
    if ((status_[pair.body_a] | status_[pair.body_b]) & (kChanged | kGone | kActive)) continue;
    while (next != resting_found_.end() && next->value < pair.key())
      merged_pairs_.push_back(toPair((next++)->value));
    merged_pairs_.push_back(pair);
  }
  while (next != resting_found_.end()) merged_pairs_.push_back(toPair((next++)->value));
  resting_pairs_.swap(merged_pairs_);
}

// Each block writes where its candidates are, then the gaps are closed.
void TreeBroadphase::selectOverlapping(TaskManager* tasks) {
  const uint32_t n = static_cast<uint32_t>(candidates_.size());
  active_pairs_.resize(n);
  block_counts_.assign(n / kSelectGrain + 1, 0);
  parallelFor(tasks, n, kSelectGrain, [&](TaskRange range) {
    uint32_t out = range.begin;
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const Pair pair = toPair(candidates_[i].value);
      active_pairs_[out] = pair;
      out += overlapFast(bounds_[pair.body_a], bounds_[pair.body_b]);
    }
    block_counts_[range.begin / kSelectGrain] = out - range.begin;
  });
  auto end = active_pairs_.begin();
  for (std::size_t block = 0; block < block_counts_.size(); ++block) {
    const auto begin = active_pairs_.begin() + static_cast<std::ptrdiff_t>(block * kSelectGrain);
    end = begin == end ? begin + block_counts_[block] : std::copy(begin, begin + block_counts_[block], end);
  }
  active_pairs_.erase(end, active_pairs_.end());
}

std::span<const Pair> TreeBroadphase::pairs() {
  if (resting_pairs_.empty()) return active_pairs_;
  all_pairs_.resize(active_pairs_.size() + resting_pairs_.size());
  std::merge(active_pairs_.begin(), active_pairs_.end(), resting_pairs_.begin(), resting_pairs_.end(),
             all_pairs_.begin(), [](const Pair& a, const Pair& b) { return a.key() < b.key(); });
  return all_pairs_;
}

}  // namespace pfx
