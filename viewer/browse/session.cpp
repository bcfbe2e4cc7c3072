#include "viewer/browse/session.h"

#include <algorithm>
#include <chrono>

#include "samples/all_in_world.h"
#include "viewer/input_error.h"

namespace viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFrameBudget = 0.05;  // s of computing that one call of advance may take
constexpr double kMaxDue = 0.1;        // s of simulation that a slow frame may leave for the next

void push(std::vector<float>& ring, double value) {
  if (ring.size() == Session::kRecent) ring.erase(ring.begin());
  ring.push_back(float(value));
}

std::vector<float> valuesOf(samples::Scene& scene) {
  std::vector<float> values;
  for (const samples::Parameter& p : scene.parameters()) values.push_back(*p.value);
  return values;
}

}  // namespace

void Session::begin(std::unique_ptr<SceneRun> run) {
  run_ = std::move(run);
  replay_.reset();
  divergence_.reset();
  recorded_from_.reset();
  for (auto* ring : {&totals_, &energies_, &penetrations_, &momenta_, &joint_errors_}) ring->clear();
  costs_.clear();
  inputs_.clear();
  grab.reset();
  parameters_ = valuesOf(run_->scene());
  start_dt_ = run_->settings().dt;
  start_solver_ = world().solver();
  shown_ = 0;
  rewound_ = false;
  exact_ = true;
  due_ = 0.0;
  history_.clear();
  history_.add(*run_, captureFrame(*run_));
  figures_ = computeFigures(world());
}

void Session::load(const SceneSpec& spec) { begin(std::make_unique<SceneRun>(spec, settings)); }

void Session::restart() {
  if (run_) load(SceneSpec(spec()));
}

void Session::open(const Recording& recording) {
  if (recording.numFrames() == 0) throw InputError("the recording has no frames");
  std::vector<RecordedFrame> frames;
  for (size_t i = 0; i < recording.numFrames(); ++i) frames.push_back(recording.frame(i));
  auto run = std::make_unique<SceneRun>(startRun(recording));
  const uint64_t first = frames.front().step;
  begin(std::move(run));
  inputs_ = recording.head().inputs;
  if (first > 0) {
    stepTo(*run_, first, inputs_);
    history_.clear();
    history_.add(*run_, captureFrame(*run_));
  }
  shown_ = first;
  if (run_->stateHash() != frames.front().state_hash) divergence_ = first;
  exact_ = !divergence_;
  replay_ = std::move(frames);
  figures_ = computeFigures(world());
}

bool Session::isAllInWorld() const { return dynamic_cast<const samples::AllInWorld*>(&scene()) != nullptr; }

void Session::measure() {
  const auto stages = world().stageTimes();
  for (const pfx::StageTime& stage : stages)
    if (std::none_of(costs_.begin(), costs_.end(), [&](const StageCost& c) { return c.name == stage.name; }))
      costs_.push_back({stage.name, std::vector<float>(totals_.size(), 0.0f)});
  // A stage that a step did not need cost nothing in it.
  double total = 0.0;
  for (StageCost& cost : costs_) {
    double now = 0.0;
    for (const pfx::StageTime& stage : stages)
      if (cost.name == stage.name) now += stage.milliseconds;
    push(cost.recent, now);
    total += now;
  }
  push(totals_, total);
  figures_ = computeFigures(world());
  push(energies_, figures_.kinetic_energy + figures_.potential_energy);
  push(penetrations_, figures_.max_penetration);
  push(momenta_, figures_.linear_momentum.norm());
  push(joint_errors_, figures_.max_joint_error);
}

void Session::makeStep() {
  if (grab && world().isValid(grab->body)) {
    inputs_.push_back({shown_, Pull{grab->body.index, grab->local, grab->target}});
    applyInput(*run_, inputs_.back().what);
  }
  run_->step();
  ++shown_;
  history_.add(*run_, captureFrame(*run_));
  measure();
}

// The recording decides what is shown; as long as the run repeats it, everything else about the step is known too.
void Session::replayStep() {
  const RecordedFrame& next = (*replay_)[size_t(shown_ + 1 - firstStep())];
  if (exact_) {
    stepTo(*run_, next.step, inputs_);
    if (shown_ == history_.last()) history_.add(*run_, captureFrame(*run_));
    measure();
    if (run_->stateHash() != next.state_hash) {
      divergence_ = std::min(divergence_.value_or(next.step), next.step);
      exact_ = false;
    }
  }
  if (!exact_ && world().states().size() == next.bodies.size()) applyFrame(world(), next);
  shown_ = next.step;
}

void Session::applySettings(uint64_t before) {
  std::vector<samples::Parameter> all = run_->scene().parameters();
  for (size_t i = 0; i < std::min(all.size(), parameters_.size()); ++i) *all[i].value = parameters_[i];
  run_->setTimeStep(start_dt_);
  for (const TimedInput& input : inputs_)
    if (input.step < before &&
        (std::holds_alternative<SetParameter>(input.what) || std::holds_alternative<SetTimeStep>(input.what)))
      applyInput(*run_, input.what);
}

void Session::runAgain(uint64_t step) {
  RunSettings start = run_->settings();
  start.dt = start_dt_;
  start.parameters = parameters_;
  auto again = std::make_unique<SceneRun>(SceneSpec(spec()), start);
  stepTo(*again, step, inputs_);
  run_ = std::move(again);
}

void Session::stepFromSnapshot(uint64_t step) {
  // At least one step is made, since a snapshot has no islands.
  history_.restoreBefore(world(), step > history_.first() ? step - 1 : step);
  applySettings(world().stepCount());
  stepTo(*run_, step, inputs_);
}

// What is done now follows the step that is shown: what was known beyond it is forgotten.
void Session::goLive() {
  if (replay_) {
    const uint64_t at = shown_;
    if (!exact_) runAgain(at);
    history_.forgetAfter(at);
    if (history_.last() < at) {
      history_.clear();
      history_.add(*run_, captureFrame(*run_));
    }
    replay_.reset();
  } else if (rewound_) {
    if (!exact_) runAgain(shown_);
    history_.forgetAfter(shown_);
  } else {
    return;
  }
  std::erase_if(inputs_, [&](const TimedInput& input) { return input.step >= shown_; });
  rewound_ = false;
  exact_ = true;
}

void Session::give(const SceneInput& input) {
  goLive();
  inputs_.push_back({shown_, input});
  applyInput(*run_, input);
}

void Session::stepForward(int count) {
  for (int i = 0; i < count; ++i) {
    if (replay_) {
      if (shown_ < lastStep()) replayStep();
    } else if (rewound_ && shown_ < lastStep()) {
      seek(shown_ + 1);
    } else {
      makeStep();
    }
  }
}

void Session::seek(uint64_t step) {
  const uint64_t to = std::clamp(step, firstStep(), lastStep());
  if (to == shown_) return;
  const bool all_in_world = isAllInWorld();
  if (replay_) {
    const RecordedFrame& frame = (*replay_)[size_t(to - firstStep())];
    const bool repeated = to <= history_.last() && (!divergence_ || to < *divergence_);
    const bool poses_alone = !(repeated && all_in_world) && world().states().size() == frame.bodies.size();
    if (poses_alone)
      applyFrame(world(), frame);
    else if (repeated && all_in_world)
      stepFromSnapshot(to);
    else
      runAgain(to);
    shown_ = to;
    exact_ = !poses_alone && run_->stateHash() == frame.state_hash;
  } else {
    if (!rewound_) present_ = takeSnapshot(world());
    rewound_ = to != lastStep();
    exact_ = true;
    if (!rewound_) {
      world().restore(present_);
      if (all_in_world) applySettings(~uint64_t(0));
    } else if (all_in_world)
      stepFromSnapshot(to);
    else if (history_.showPoses(world(), to))
      exact_ = false;
    else
      runAgain(to);
    shown_ = to;
  }
  figures_ = computeFigures(world());
}

void Session::advance(double seconds) {
  if (!run_ || paused) return;
  if (!replay_) goLive();
  due_ = std::min(due_ + seconds * speed, kMaxDue * std::max(1.0, double(speed)));
  const auto start = Clock::now();
  while (due_ >= double(run_->settings().dt)) {
    due_ -= double(run_->settings().dt);
    if (replay_ && shown_ >= lastStep()) {
      paused = true;
      break;
    }
    replay_ ? replayStep() : makeStep();
    if (std::chrono::duration<double>(Clock::now() - start).count() > kFrameBudget) break;
  }
}

std::vector<uint8_t> Session::stopRecording() {
  const uint64_t from = std::max(recorded_from_.value_or(shown_), history_.first());
  recorded_from_.reset();
  // The head of a file has no place for other solvers than those of the scene.
  std::vector<TimedInput> inputs = inputs_;
  const RunSettings& set = run_->settings();
  if (set.joint_solver || set.contact_solver) inputs.insert(inputs.begin(), {0, start_solver_});
  RecordingWriter writer({.target = spec().target(),
                          .dt = start_dt_,
                          .substeps = uint32_t(start_solver_.substeps),
                          .parameters = parameters_,
                          .inputs = std::move(inputs)});
  for (uint64_t step = from; step <= std::max(from, shown_) && step <= history_.last(); ++step)
    writer.add(history_.frame(step));
  return writer.bytes();
}

const RecordedFrame* Session::remembered(uint64_t step) const {
  if (replay_) return step >= firstStep() && step <= lastStep() ? &(*replay_)[size_t(step - firstStep())] : nullptr;
  return step >= history_.first() && step <= history_.last() ? &history_.frame(step) : nullptr;
}

}  // namespace viewer
