// The trees of the broad phase: who lies where, and which leaves have to move. Pairs have a file of their
// own.
#include "pfx/low_level/broadphase/tree_broadphase.h"

#include <algorithm>

namespace pfx {

namespace {

constexpr uint32_t kUnmoved = 0xffffffffu;
constexpr uint32_t kMaxBodies = 1u << 31;
constexpr uint32_t kGrain = 512;     // proxies a block
constexpr float kSizeMargin = 0.1f;  // of the smallest half extent, on every side of a leaf
constexpr float kStepsAhead = 4.0f;  // by which a leaf reaches ahead of its proxy
constexpr float kMaxAhead = 2.0f;    // of the largest half extent; what is faster moves its leaf in each step
constexpr float kFarthest = 1e30f;   // m; leaves end there, so that sums of coordinates stay finite
constexpr uint32_t kRebuildShare = 8;  // a tree is built anew when one in so many leaves moves,
constexpr uint32_t kBulkShare = 4;     // or one in so many is added
constexpr uint32_t kFewLeaves = 32;

bool isBox(const Aabb& box) { return (box.min.array() <= box.max.array()).all(); }

// The leaf of a proxy that moved by `step` (m) since the last update.
Aabb fatBounds(const Aabb& box, const Vec3& step) {
  const Vec3 half = box.halfExtent();
  const float limit = kMaxAhead * half.maxCoeff();
  const Vec3 ahead = (kStepsAhead * step).cwiseMax(Vec3::Constant(-limit)).cwiseMin(Vec3::Constant(limit));
  Aabb fat = box.grown(kSizeMargin * half.minCoeff());
  fat.min += ahead.cwiseMin(0.0f);
  fat.max += ahead.cwiseMax(0.0f);
  // With bounds that are not finite the sums may be no numbers; the box itself is always part of it.
  fat.min = (fat.min.array() <= box.min.array()).select(fat.min, box.min);
  fat.max = (fat.max.array() >= box.max.array()).select(fat.max, box.max);
  return leafBounds(fat);
}

}  // namespace

void TreeBroadphase::grow(uint32_t num_bodies) {
  if (num_bodies <= records_.size()) return;
  records_.resize(num_bodies);
  bounds_.resize(num_bodies);
  locations_.resize(num_bodies, DynamicTree::kNowhere);
}

// Removes a body from its tree, if it is in one.
void TreeBroadphase::takeOut(uint32_t body) {
  Record& record = records_[body];
  if (record.home == Home::Resting) {
    resting_changed_ = true;
    num_restless_ -= record.motion_type != MotionType::Fixed;
  }
  if (locations_[body] != DynamicTree::kNowhere) {
    (record.home == Home::Active ? active_tree_ : resting_tree_).remove(locations_[body], locations_);
  }
  record.home = Home::None;
}

void TreeBroadphase::addLeaves(DynamicTree& tree, std::vector<TreeLeaf>& leaves) {
  if (leaves.size() < kFewLeaves || leaves.size() < tree.size() / kBulkShare) {
    for (const TreeLeaf& leaf : leaves) tree.insert(leaf, locations_);
    return;
  }
  tree.overlap(tree.bounds(), [&](uint32_t id) { leaves.push_back({tree.boundsAt(locations_[id]), id}); });
  tree.build(leaves, locations_);
}

Error TreeBroadphase::rest(std::span<const BroadphaseProxy> proxies) {
  uint32_t num_bodies = 0;
  for (const BroadphaseProxy& proxy : proxies) {
    if (proxy.body >= kMaxBodies) return Error::OutOfRange;
    num_bodies = std::max(num_bodies, proxy.body + 1);
  }
  grow(num_bodies);
  std::vector<TreeLeaf> leaves;  // may be large, and is not needed again
  for (const BroadphaseProxy& proxy : proxies) {
    const uint32_t body = proxy.body;
    Record& record = records_[body];
    const bool is_repeated = record.home == Home::Resting && locations_[body] == DynamicTree::kNowhere;
    takeOut(body);
    if (!record.changed) fresh_.push_back(body);
    record.filter_self = proxy.filter_self, record.filter_target = proxy.filter_target;
    record.motion_type = proxy.motion_type;
    record.home = Home::Resting;
    record.changed = true;
    num_restless_ += record.motion_type != MotionType::Fixed;
    bounds_[body] = proxy.bounds;
    if (is_repeated) std::erase_if(leaves, [&](const TreeLeaf& leaf) { return leaf.id == body; });
    if (isBox(proxy.bounds)) leaves.push_back({leafBounds(proxy.bounds), body});
  }
  resting_changed_ = true;
  addLeaves(resting_tree_, leaves);
  return Error::Ok;
}

void TreeBroadphase::remove(uint32_t body) {
  if (!contains(body)) return;
  takeOut(body);
  resting_changed_ = true;
}

uint32_t TreeBroadphase::size() const {
  return static_cast<uint32_t>(
      std::ranges::count_if(records_, [](const Record& r) { return r.home != Home::None; }));
}

std::size_t TreeBroadphase::memoryBytes() const {
  return records_.capacity() * sizeof(Record) + bounds_.capacity() * sizeof(Aabb) +
         locations_.capacity() * sizeof(DynamicTree::Location) + resting_tree_.memoryBytes() +
         active_tree_.memoryBytes() + candidates_.capacity() * sizeof(PairKey) +
         (active_pairs_.capacity() + resting_pairs_.capacity() + all_pairs_.capacity()) * sizeof(Pair);
}

Error TreeBroadphase::update(std::span<const BroadphaseProxy> active, TaskManager* tasks) {
  for (std::size_t i = 1; i < active.size(); ++i) {
    if (active[i - 1].body >= active[i].body) return Error::OutOfRange;
  }
  if (!active.empty() && active.back().body >= kMaxBodies) return Error::OutOfRange;
  if (!active.empty()) grow(active.back().body + 1);
  ++stamp_;
  compareWithLeaves(active, tasks);
  restTheMissing(active);
  moveLeaves(active);
  search(tasks);
  updateCandidates();
  updateRestingPairs();
  selectOverlapping(tasks);
  for (uint32_t body : moved_) records_[body].changed = false;
  for (uint32_t body : fresh_) records_[body].changed = false;
  fresh_.clear();
  return Error::Ok;
}

// Takes over the exact bounds, and makes a new leaf for each proxy that has left its old one.
void TreeBroadphase::compareWithLeaves(std::span<const BroadphaseProxy> active, TaskManager* tasks) {
  leaf_of_.resize(active.size());
  parallelFor(tasks, static_cast<uint32_t>(active.size()), kGrain, [&](TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const BroadphaseProxy& proxy = active[i];
      const uint32_t body = proxy.body;
      Record& record = records_[body];
      const bool was_active = record.home == Home::Active;
      const bool same_kind = record.filter_self == proxy.filter_self &&
                             record.filter_target == proxy.filter_target &&
                             record.motion_type == proxy.motion_type;
      const bool in_tree = locations_[body] != DynamicTree::kNowhere;
      record.stamp = stamp_;
      leaf_of_[i].id = kUnmoved;
      if (!isBox(proxy.bounds)) {
        bounds_[body] = proxy.bounds;
        if (!was_active || in_tree || !same_kind) leaf_of_[i] = {proxy.bounds, body};
        continue;
      }
      const Vec3 step =
          was_active && in_tree ? Vec3(proxy.bounds.center() - bounds_[body].center()) : Vec3::Zero();
      bounds_[body] = proxy.bounds;
      if (was_active && same_kind && in_tree &&
          active_tree_.boundsAt(locations_[body]).contains(leafBounds(proxy.bounds))) {
        continue;
      }
      leaf_of_[i] = {fatBounds(proxy.bounds, step), body};
    }
  });
}

void TreeBroadphase::restTheMissing(std::span<const BroadphaseProxy> active) {
  leaves_.clear();
  for (uint32_t body : active_) {
    Record& record = records_[body];
    if (record.home != Home::Active || record.stamp == stamp_) continue;
    takeOut(body);
    record.home = Home::Resting;
    num_restless_ += record.motion_type != MotionType::Fixed;
    resting_changed_ = true;
    if (isBox(bounds_[body])) leaves_.push_back({leafBounds(bounds_[body]), body});
  }
  addLeaves(resting_tree_, leaves_);
  active_.resize(active.size());
  std::ranges::transform(active, active_.begin(), &BroadphaseProxy::body);
}

// Moves the leaves that compareWithLeaves wants moved.
void TreeBroadphase::moveLeaves(std::span<const BroadphaseProxy> active) {
  moved_.clear();
  for (const TreeLeaf& leaf : leaf_of_) {
    if (leaf.id != kUnmoved) moved_.push_back(leaf.id);
  }
  const bool rebuild = moved_.size() >= kFewLeaves && moved_.size() >= active.size() / kRebuildShare;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (leaf_of_[i].id == kUnmoved) continue;
    const BroadphaseProxy& proxy = active[i];
    Record& record = records_[proxy.body];
    if (!rebuild || record.home != Home::Active) takeOut(proxy.body);
    record.filter_self = proxy.filter_self, record.filter_target = proxy.filter_target;
    record.motion_type = proxy.motion_type;
    record.home = Home::Active;
    record.changed = true;
    if (!rebuild && isBox(leaf_of_[i].bounds)) active_tree_.insert(leaf_of_[i], locations_);
  }
  if (rebuild) rebuildActiveTree(active);
}

void TreeBroadphase::rebuildActiveTree(std::span<const BroadphaseProxy> active) {
  leaves_.clear();
  for (std::size_t i = 0; i < active.size(); ++i) {
    const uint32_t body = active[i].body;
    if (leaf_of_[i].id == kUnmoved) {
      if (locations_[body] != DynamicTree::kNowhere) {
        leaves_.push_back({active_tree_.boundsAt(locations_[body]), body});
      }
    } else if (isBox(leaf_of_[i].bounds)) {
      leaves_.push_back(leaf_of_[i]);
    } else {
      locations_[body] = DynamicTree::kNowhere;
    }
  }
  active_tree_.build(leaves_, locations_);
}

}  // namespace pfx
