#include "viewer/browse/history.h"

#include <algorithm>

namespace viewer {

std::vector<std::byte> takeSnapshot(const pfx::World& world) {
  std::vector<std::byte> bytes(world.snapshotBytes());
  bytes.resize(world.snapshot(bytes));
  return bytes;
}

void History::clear() { *this = History(); }

void History::add(const SceneRun& run, RecordedFrame frame) {
  const bool first = frames_.empty();
  const bool other_bodies = !first && frames_.back().bodies.size() != frame.bodies.size();
  if (first) first_ = frame.step;
  if (first || other_bodies || frame.step >= snapshots_.back().step + interval_) {
    snapshots_.push_back({frame.step, takeSnapshot(run.world())});
    snapshot_bytes_ += snapshots_.back().bytes.size();
    thinOut();
  }
  frames_.push_back(std::move(frame));
  const size_t bytes = std::max<size_t>(1, frames_.back().bodies.size()) * sizeof(RecordedBody);
  while (frames_.size() > 1 && frames_.size() * bytes > kPoseBytes) {
    frames_.pop_front();
    ++first_;
  }
}

// The first one stays: everything can be made again from it.
void History::thinOut() {
  while (snapshot_bytes_ > kSnapshotBytes && snapshots_.size() > 2) {
    interval_ *= 2;
    std::vector<Snapshot> kept;
    snapshot_bytes_ = 0;
    for (size_t i = 0; i < snapshots_.size(); i += 2) {
      kept.push_back(std::move(snapshots_[i]));
      snapshot_bytes_ += kept.back().bytes.size();
    }
    snapshots_ = std::move(kept);
  }
}

void History::forgetAfter(uint64_t step) {
  if (step < last()) frames_.resize(size_t(step - first_ + 1));
  while (snapshots_.size() > 1 && snapshots_.back().step > step) {
    snapshot_bytes_ -= snapshots_.back().bytes.size();
    snapshots_.pop_back();
  }
}

bool History::restoreBefore(pfx::World& world, uint64_t step) const {
  const auto after = std::ranges::upper_bound(snapshots_, step, {}, &Snapshot::step);
  if (after == snapshots_.begin()) return false;
  world.restore((after - 1)->bytes);
  return true;
}

bool History::showPoses(pfx::World& world, uint64_t step) const {
  const RecordedFrame& shown = frame(step);
  if (world.states().size() != shown.bodies.size()) {
    if (!restoreBefore(world, step) || world.states().size() != shown.bodies.size()) return false;
  }
  applyFrame(world, shown);
  return true;
}

}  // namespace viewer
