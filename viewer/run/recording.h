// A recording of a run: poses and velocities of every body after every step, with the state hash of each, so
// that any frame can be shown at once and a run can be checked against it; and what a person did meanwhile, so that it
// can be run again.
//
// File, little endian, version 3 (2 is read as well):
//   char[8] "VTRNREC\n" | u32 version | f32 dt (s) | u32 sub-steps | u32 frames | u32 length of target |
//   u32 parameters | u32 inputs | target | parameters x f32 |
//   inputs x (u64 step, u32 kind, u32 index, 8 f32; kinds are those of SceneInput) |
//   u64[frames + 1] offsets of the frames from the start of the file; the last is their end
//   frames: u64 step | u64 state hash of the run | u32 bodies | bodies x 13 f32 (position, orientation x y z w, linear
//           velocity, angular velocity) | bodies x u8 (1: asleep)
//   u64 XXH3 of everything before it
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "viewer/run/scene_input.h"

namespace viewer {

struct RecordedBody {
  pfx::Vec3 position;
  pfx::Quat orientation;
  pfx::Vec3 linear_velocity, angular_velocity;
  bool asleep = false;
};

struct RecordedFrame {
  uint64_t step = 0, state_hash = 0;
  std::vector<RecordedBody> bodies;  // by body index
};

// The run as it is now.
RecordedFrame captureFrame(const SceneRun& run);

struct RecordingHead {
  std::string target;  // of the scene
  float dt = 0.0f;     // s, at the start of the run
  uint32_t substeps = 0;  // at the start of the run
  std::vector<float> parameters = {};   // of the scene when it was built
  std::vector<TimedInput> inputs = {};  // since the start of the run, ascending by step
};

class RecordingWriter {
 public:
  explicit RecordingWriter(RecordingHead head) : head_(std::move(head)) {}

  void add(const RecordedFrame& frame);
  std::vector<uint8_t> bytes() const;  // of the file
  size_t numFrames() const { return ends_.size(); }

 private:
  RecordingHead head_;
  std::vector<uint8_t> frames_;
  std::vector<uint64_t> ends_;  // of each frame in frames_
};

class Recording {
 public:
  // Throws InputError, beginning with `name`, for a file that is cut off, damaged or of another version.
  Recording(std::vector<uint8_t> bytes, const std::string& name);
  static Recording read(const std::filesystem::path& file);

  const RecordingHead& head() const { return head_; }
  size_t numFrames() const { return offsets_.size() - 1; }
  // Throws std::out_of_range when index >= numFrames().
  RecordedFrame frame(size_t index) const;

 private:
  RecordingHead head_;
  std::vector<uint8_t> bytes_;
  std::vector<uint64_t> offsets_;
};

// The run at its start, as the recording was made.
SceneRun startRun(const Recording& recording);

// Puts the bodies of the world where the frame has them. Throws InputError when the numbers of bodies differ.
void applyFrame(pfx::World& world, const RecordedFrame& frame);

}  // namespace viewer
