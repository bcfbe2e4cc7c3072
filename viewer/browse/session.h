// The scene that is being browsed: its run, its past, its speed. No window and no GL.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/run/figures.h"
#include "viewer/run/recording.h"
#include "viewer/run/scene_run.h"

namespace viewer {

// The cost of a stage over the last steps.
struct StageCost {
  std::string name;
  std::vector<float> recent;  // ms, oldest first, at most Session::kRecent
};

// A body that the mouse pulls.
struct Grab {
  pfx::BodyId body;
  pfx::Vec3 local;   // m, the point that is held, in the frame of the body
  pfx::Vec3 target;  // m, where the mouse wants it
};

class Session {
 public:
  static constexpr size_t kRecent = 240;               // steps that plots show
  static constexpr size_t kHistoryBytes = 256u << 20;  // of remembered poses

  // Throws what the scene throws; then the session is as it was.
  void load(const SceneSpec& spec);
  void restart();
  bool loaded() const { return run_ != nullptr; }
  const SceneSpec& spec() const { return run_->spec(); }
  pfx::World& world() { return run_->world(); }
  const pfx::World& world() const { return run_->world(); }
  const samples::Scene& scene() const { return run_->scene(); }

  // The step that the world shows, and those that it can show.
  uint64_t step() const { return shown_; }
  uint64_t firstStep() const { return first_; }
  uint64_t lastStep() const { return first_ + history_.size() - 1; }

  bool paused = true;
  float speed = 1.0f;    // simulated seconds a second
  RunSettings settings;  // act from the next load or restart
  std::optional<Grab> grab;

  // Lets real time pass: makes the steps that are due, but never for longer than a frame may take.
  void advance(double seconds);
  void stepForward(int count = 1);
  // Shows an earlier step from memory. Going on from there runs the scene again up to it, so that what
  // follows is what followed before, to the bit; after a hand of the user in the scene it goes on from the
  // poses alone.
  void seek(uint64_t step);
  void stepBack(uint64_t count) { seek(shown_ > count ? shown_ - count : 0); }

  // Throws a ball of the given radius from a place (m) with a velocity (m/s).
  void throwBall(const pfx::Vec3& from, const pfx::Vec3& velocity, float radius);

  const std::vector<StageCost>& costs() const { return costs_; }
  const std::vector<float>& totals() const { return totals_; }              // ms a step
  const std::vector<float>& energies() const { return energies_; }          // J, kinetic and potential
  const std::vector<float>& penetrations() const { return penetrations_; }  // m
  const Figures& figures() const { return figures_; }

 private:
  void makeStep();
  void resumeFromShown();
  void remember();
  void measure();
  void pull();
  void forget();

  std::unique_ptr<SceneRun> run_;
  std::deque<RecordedFrame> history_;
  uint64_t first_ = 0, shown_ = 0;
  bool rewound_ = false;  // the world shows remembered poses and cannot go on from them
  bool touched_ = false;  // the user pulled or threw something: running the scene again would not lead here
  double due_ = 0.0;      // s of simulation not made yet
  std::vector<StageCost> costs_;
  std::vector<float> totals_, energies_, penetrations_;
  Figures figures_;
};

}  // namespace viewer
