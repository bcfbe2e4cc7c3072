// The trees of the broad phase: who lies where, and which leaves have to move. Pairs have a file of their
// own.
#include "pfx/low_level/broadphase/tree_broadphase.h"

#include <algorithm>

namespace pfx {

namespace {

constexpr uint32_t kUnmoved = 0xffffffffu;
constexpr uint32_t kMaxBodies = 1u << 31;
constexpr uint32_t kGrain = 512;     // proxies a block
constexpr float kSizeMargin = 0.2f;  // of the smallest half extent, on every side of a leaf
constexpr float kStepsAhead = 3.0f;  // by which a leaf reaches ahead of its proxy
constexpr float kMaxAhead = 2.0f;    // of the largest half extent; what is faster moves its leaf in each step
constexpr uint32_t kRefitShare = 8;  // the active tree is refitted when one leaf in so many moves,
constexpr uint32_t kMovesPerBuild = 2;  // and built anew when its leaves have moved so often since
constexpr uint32_t kBulkShare = 4;      // a tree is built anew when one leaf in so many is added
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
  if (num_bodies <= status_.size()) return;
  status_.resize(num_bodies, kGone);
  records_.resize(num_bodies);
  bounds_.resize(num_bodies);
  locations_.resize(num_bodies, DynamicTree::kNowhere);
}

// Gives a body its kind and its home, and has its pairs searched for. Its leaf is the caller's business.
void TreeBroadphase::settle(const BroadphaseProxy& proxy, Status home) {
  const uint32_t body = proxy.body;
  records_[body].filter_self = proxy.filter_self;
  records_[body].filter_target = proxy.filter_target;
  status_[body] =
      static_cast<uint8_t>(home | kChanged | static_cast<uint8_t>(proxy.motion_type) << kTypeShift);
  num_restless_ += home == kResting && proxy.motion_type != MotionType::Fixed;
}

// True when the body is active and of the kind that the proxy says.
bool TreeBroadphase::isSettled(const BroadphaseProxy& proxy) const {
  const Record& record = records_[proxy.body];
  return (status_[proxy.body] & kActive) && typeOf(proxy.body) == proxy.motion_type &&
         record.filter_self == proxy.filter_self && record.filter_target == proxy.filter_target;
}

// Removes a body from its tree, if it is in one. What is left is a body that is gone.
void TreeBroadphase::takeOut(uint32_t body) {
  const bool is_resting = status_[body] & kResting;
  if (is_resting) {
    resting_changed_ = true;
    num_restless_ -= typeOf(body) != MotionType::Fixed;
  }
  if (locations_[body] != DynamicTree::kNowhere) {
    (is_resting ? resting_tree_ : active_tree_).remove(locations_[body], locations_);
  }
  status_[body] = static_cast<uint8_t>((status_[body] & ~(kResting | kActive)) | kGone);
}

void TreeBroadphase::addLeaves(DynamicTree& tree, Vector<TreeLeaf>& leaves) {
  if (leaves.size() < kFewLeaves || leaves.size() < tree.size() / kBulkShare) {
    for (const TreeLeaf& leaf : leaves) tree.insert(leaf, locations_);
    return;
  }
  tree.overlap(tree.bounds(), [&](uint32_t id) { leaves.push_back({tree.boundsAt(locations_[id]), id}); });
  tree.build(leaves, locations_);
}

Error TreeBroadphase::rest(std::span<const BroadphaseProxy> proxies) {
  if (proxies.empty()) return Error::Ok;  // the pairs at rest need no look then
  uint32_t num_bodies = 0;
  for (const BroadphaseProxy& proxy : proxies) {
    if (proxy.body >= kMaxBodies) return Error::OutOfRange;
    num_bodies = std::max(num_bodies, proxy.body + 1);
  }
  grow(num_bodies);
  Vector<TreeLeaf> leaves;  // may be large, and is not needed again
  for (const BroadphaseProxy& proxy : proxies) {
    const uint32_t body = proxy.body;
    const bool is_repeated = (status_[body] & kResting) && locations_[body] == DynamicTree::kNowhere;
    takeOut(body);
    if (!(status_[body] & kChanged)) fresh_.push_back(body);
    settle(proxy, kResting);
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
  return static_cast<uint32_t>(std::ranges::count_if(status_, [](uint8_t s) { return !(s & kGone); }));
}

std::size_t TreeBroadphase::memoryBytes() const {
  return status_.capacity() + records_.capacity() * sizeof(Record) + bounds_.capacity() * sizeof(Aabb) +
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
  for (uint32_t body : moved_) status_[body] &= static_cast<uint8_t>(~kChanged);
  for (uint32_t body : fresh_) status_[body] &= static_cast<uint8_t>(~kChanged);
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
      const bool has_leaf = isSettled(proxy) && locations_[body] != DynamicTree::kNowhere;
      const Vec3 step = has_leaf ? Vec3(proxy.bounds.center() - bounds_[body].center()) : Vec3::Zero();
      records_[body].stamp = stamp_;
      bounds_[body] = proxy.bounds;
      leaf_of_[i].id = kUnmoved;
      if (!isBox(proxy.bounds)) {
        if (has_leaf || !isSettled(proxy)) leaf_of_[i] = {proxy.bounds, body};
      } else if (!has_leaf || !active_tree_.boundsAt(locations_[body]).contains(leafBounds(proxy.bounds))) {
        leaf_of_[i] = {fatBounds(proxy.bounds, step), body};
      }
    }
  });
}

void TreeBroadphase::restTheMissing(std::span<const BroadphaseProxy> active) {
  leaves_.clear();
  for (uint32_t body : active_) {
    if (!(status_[body] & kActive) || records_[body].stamp == stamp_) continue;
    takeOut(body);
    status_[body] = static_cast<uint8_t>((status_[body] & ~kGone) | kResting);
    num_restless_ += typeOf(body) != MotionType::Fixed;
    resting_changed_ = true;
    if (isBox(bounds_[body])) leaves_.push_back({leafBounds(bounds_[body]), body});
  }
  addLeaves(resting_tree_, leaves_);
  active_.resize(active.size());
  std::ranges::transform(active, active_.begin(), &BroadphaseProxy::body);
}

// Moves the leaves that compareWithLeaves wants moved: one by one when they are few, else all in their
// places, with a new tree whenever each leaf has moved twice on the average.
void TreeBroadphase::moveLeaves(std::span<const BroadphaseProxy> active) {
  moved_.clear();
  for (const TreeLeaf& leaf : leaf_of_) {
    if (leaf.id != kUnmoved) moved_.push_back(leaf.id);
  }
  const bool are_many = moved_.size() >= kFewLeaves && moved_.size() >= active.size() / kRefitShare;
  if (are_many) moved_since_build_ += static_cast<uint32_t>(moved_.size());
  const bool rebuild = are_many && moved_since_build_ > kMovesPerBuild * active_tree_.size();
  for (std::size_t i = 0; i < active.size(); ++i) {
    const TreeLeaf& leaf = leaf_of_[i];
    if (leaf.id == kUnmoved) continue;
    const uint32_t body = active[i].body;
    const bool in_tree = (status_[body] & kActive) && locations_[body] != DynamicTree::kNowhere;
    const bool is_near = are_many && in_tree && isBox(leaf.bounds) &&
                         active_tree_.boundsAt(locations_[body]).overlaps(leaf.bounds);
    const bool stays = is_near || (in_tree && rebuild);
    if (!stays) takeOut(body);
    settle(active[i], kActive);
    if (rebuild || !isBox(leaf.bounds)) continue;
    if (stays) {
      active_tree_.setBounds(locations_[body], leaf.bounds);
    } else {
      active_tree_.insert(leaf, locations_);
    }
  }
  if (rebuild) {
    rebuildActiveTree(active);
  } else if (are_many) {
    active_tree_.refit();
  }
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
  moved_since_build_ = 0;
}

}  // namespace pfx
