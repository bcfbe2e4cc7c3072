// The scene that is being browsed: its run, its past, its speed. No window and no GL.
//
// Everything that a person does to the run is kept as an input of the step before which it was done, so that any step
// of the past can be made again to the bit: from a snapshot of the world when the scene is all in the world, else from
// the start of the scene.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/browse/history.h"
#include "viewer/run/figures.h"

namespace viewer {

// The cost of a stage over the last steps.
struct StageCost {
  std::string name;
  std::vector<float> recent;  // ms, oldest first, as many as there are totals
};

// A body that the mouse pulls.
struct Grab {
  pfx::BodyId body;
  pfx::Vec3 local;   // m, the point that is held, in the frame of the body
  pfx::Vec3 target;  // m, where the mouse wants it
};

class Session {
 public:
  static constexpr size_t kRecent = 240;  // steps that plots show

  // Throws what the scene throws; then the session is as it was.
  void load(const SceneSpec& spec);
  // Shows a run that was built elsewhere.
  void take(std::unique_ptr<SceneRun> run) { begin(std::move(run)); }
  void restart();
  // Shows a recording: going on repeats it and compares. Throws InputError when its scene is not known.
  void open(const Recording& recording);

  bool loaded() const { return run_ != nullptr; }
  const SceneSpec& spec() const { return run_->spec(); }
  pfx::World& world() { return run_->world(); }
  const pfx::World& world() const { return run_->world(); }
  const samples::Scene& scene() const { return run_->scene(); }
  std::vector<samples::Parameter> parameters() { return run_->scene().parameters(); }
  float timeStep() const { return run_->settings().dt; }  // s

  // The step that the world shows, and those that it can show.
  uint64_t step() const { return shown_; }
  uint64_t firstStep() const { return replay_ ? replay_->front().step : history_.first(); }
  uint64_t lastStep() const { return replay_ ? replay_->back().step : history_.last(); }
  // Contacts, islands and impulses are those of the step as well; otherwise only poses are.
  bool isExact() const { return exact_; }

  bool paused = true;
  float speed = 1.0f;    // simulated seconds a second
  RunSettings settings;  // act from the next load or restart
  std::optional<Grab> grab;

  // Lets real time pass: makes the steps that are due, but never for longer than a frame may take.
  void advance(double seconds);
  void stepForward(int count = 1);
  // Shows an earlier step. Going on from there leads to what followed before, to the bit, unless something else is
  // done.
  void seek(uint64_t step);
  void stepBack(uint64_t count) { seek(shown_ > count ? shown_ - count : 0); }

  // Does something to the run, now. The future that was known is given up; a recording that was shown goes on live.
  void give(const SceneInput& input);

  // Recording, from the step that is shown on.
  void startRecording() { recorded_from_ = shown_; }
  bool isRecording() const { return recorded_from_.has_value(); }
  std::vector<uint8_t> stopRecording();  // the bytes of the file

  // A recording is being shown; the first of its steps that the run did not repeat.
  bool isReplay() const { return replay_.has_value(); }
  std::optional<uint64_t> divergence() const { return divergence_; }

  const std::vector<StageCost>& costs() const { return costs_; }
  const std::vector<float>& totals() const { return totals_; }              // ms a step
  const std::vector<float>& energies() const { return energies_; }          // J, kinetic and potential
  const std::vector<float>& penetrations() const { return penetrations_; }  // m
  const std::vector<float>& momenta() const { return momenta_; }            // kg m/s
  const std::vector<float>& jointErrors() const { return joint_errors_; }   // m
  const Figures& figures() const { return figures_; }

  // Where every body was in a step that is remembered.
  const RecordedFrame* remembered(uint64_t step) const;

 private:
  void begin(std::unique_ptr<SceneRun> run);
  void makeStep();
  void replayStep();
  void goLive();
  void runAgain(uint64_t step);
  void stepFromSnapshot(uint64_t step);
  void applySettings(uint64_t before);  // parameters and time step as they were before a step
  bool isAllInWorld() const;  // the scene
  void measure();

  std::unique_ptr<SceneRun> run_;
  History history_;
  std::vector<TimedInput> inputs_;
  std::vector<float> parameters_;  // at the start of the run
  float start_dt_ = samples::kTimeStep;
  pfx::SolverSettings start_solver_;
  std::vector<std::byte> present_;  // snapshot of the last step, while an earlier one is shown
  uint64_t shown_ = 0;
  bool rewound_ = false;  // an earlier step than the last is shown
  bool exact_ = true;
  std::optional<uint64_t> recorded_from_;
  std::optional<std::vector<RecordedFrame>> replay_;
  std::optional<uint64_t> divergence_;
  double due_ = 0.0;  // s of simulation not made yet
  std::vector<StageCost> costs_;
  std::vector<float> totals_, energies_, penetrations_, momenta_, joint_errors_;
  Figures figures_;
};

}  // namespace viewer
