// The past of a run: the poses of every step, and snapshots of the world now and then from which a step can be made
// again. What takes too much memory is forgotten, the oldest poses first and every other snapshot.
#pragma once

#include <deque>
#include <vector>

#include "viewer/run/recording.h"

namespace viewer {

class History {
 public:
  static constexpr size_t kPoseBytes = 256u << 20;      // of remembered poses
  static constexpr size_t kSnapshotBytes = 128u << 20;  // of snapshots
  static constexpr uint64_t kFirstInterval = 30;        // steps between two snapshots, as long as they have room

  void clear();
  void add(const SceneRun& run, RecordedFrame frame);  // the frame of the run as it is now
  void forgetAfter(uint64_t step);

  uint64_t first() const { return first_; }
  uint64_t last() const { return first_ + frames_.size() - 1; }
  const RecordedFrame& frame(uint64_t step) const { return frames_[size_t(step - first_)]; }

  // Brings the world to the last snapshot at or before `step`; false when there is none.
  bool restoreBefore(pfx::World& world, uint64_t step) const;
  // Shows the poses of a step, after the snapshot that has its bodies; false when no snapshot has.
  bool showPoses(pfx::World& world, uint64_t step) const;

 private:
  struct Snapshot {
    uint64_t step;
    std::vector<std::byte> bytes;
  };
  void thinOut();

  std::deque<RecordedFrame> frames_;
  std::vector<Snapshot> snapshots_;
  size_t snapshot_bytes_ = 0;
  uint64_t first_ = 0, interval_ = kFirstInterval;
};

std::vector<std::byte> takeSnapshot(const pfx::World& world);

}  // namespace viewer
