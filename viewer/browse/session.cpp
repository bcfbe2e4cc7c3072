#include "viewer/browse/session.h"

#include <algorithm>
#include <chrono>
#include <string>

namespace viewer {

namespace {

using pfx::Vec3;
using Clock = std::chrono::steady_clock;

constexpr double kFrameBudget = 0.05;  // s of computing that one call of advance may take
constexpr double kMaxDue = 0.1;        // s of simulation that a slow frame may leave for the next

RecordedFrame capture(const pfx::World& world) {
  RecordedFrame frame{world.stepCount(), world.stateHash(), {}};
  frame.bodies.reserve(world.states().size());
  for (const pfx::RigidState& s : world.states())
    frame.bodies.push_back({s.position, s.orientation, s.linear_velocity, s.angular_velocity, s.asleep});
  return frame;
}

void push(std::vector<float>& ring, double value) {
  if (ring.size() == Session::kRecent) ring.erase(ring.begin());
  ring.push_back(float(value));
}

}  // namespace

void Session::load(const SceneSpec& spec) {
  auto next = std::make_unique<SceneRun>(spec, settings);
  run_ = std::move(next);
  forget();
}

void Session::restart() {
  if (run_) load(SceneSpec(spec()));
}

void Session::forget() {
  history_.clear();
  costs_.clear();
  totals_.clear();
  energies_.clear();
  penetrations_.clear();
  grab.reset();
  first_ = shown_ = 0;
  rewound_ = touched_ = false;
  due_ = 0.0;
  remember();
  figures_ = computeFigures(world());
}

void Session::remember() {
  history_.push_back(capture(world()));
  const size_t bytes = std::max<size_t>(1, history_.back().bodies.size()) * sizeof(RecordedBody);
  while (history_.size() > 1 && history_.size() * bytes > kHistoryBytes) {
    history_.pop_front();
    ++first_;
  }
}

void Session::measure() {
  double total = 0.0;
  for (const pfx::StageTime& stage : world().stageTimes()) {
    total += stage.milliseconds;
    auto found =
        std::find_if(costs_.begin(), costs_.end(), [&](const StageCost& c) { return c.name == stage.name; });
    if (found == costs_.end()) found = costs_.insert(costs_.end(), StageCost{stage.name, {}});
    push(found->recent, stage.milliseconds);
  }
  push(totals_, total);
  figures_ = computeFigures(world());
  push(energies_, figures_.kinetic_energy + figures_.potential_energy);
  push(penetrations_, figures_.max_penetration);
}

// A damped spring between the held point and the mouse, no stronger than a few times the weight of the body.
// Position and velocity are those of the held point, so that the body swings under it.
void Session::pull() {
  if (!grab || !world().isValid(grab->body)) return;
  constexpr float kRate = 10.0f;              // rad/s, of the spring
  constexpr float kMaxAcceleration = 120.0f;  // m/s^2
  pfx::RigidState& s = world().state(grab->body);
  const Vec3 arm = s.orientation * grab->local;
  const Vec3 velocity = s.linear_velocity + s.angular_velocity.cross(arm);
  Vec3 acceleration = kRate * kRate * (grab->target - s.position - arm) - 2.0f * kRate * velocity;
  if (acceleration.norm() > kMaxAcceleration) acceleration *= kMaxAcceleration / acceleration.norm();
  const float dt = run_->settings().dt, mass = world().body(grab->body).mass;
  const pfx::Mat3 r = s.orientation.toRotationMatrix();
  const Vec3 impulse = 0.5f * mass * dt * acceleration;
  s.linear_velocity += impulse / mass;
  s.angular_velocity += r * world().body(grab->body).inertia.inverse() * r.transpose() * arm.cross(impulse);
  s.angular_velocity *= 0.96f;
  touched_ = true;
}

void Session::makeStep() {
  pull();
  run_->step();
  ++shown_;
  remember();
  measure();
}

void Session::resumeFromShown() {
  if (!rewound_) return;
  if (!touched_) {
    auto again = std::make_unique<SceneRun>(SceneSpec(spec()), run_->settings());
    again->stepTo(shown_);
    run_ = std::move(again);
  }
  history_.resize(size_t(shown_ - first_ + 1));
  rewound_ = false;
}

void Session::stepForward(int count) {
  for (int i = 0; i < count; ++i) {
    if (rewound_ && shown_ < lastStep()) {
      seek(shown_ + 1);
    } else {
      resumeFromShown();
      makeStep();
    }
  }
}

void Session::seek(uint64_t step) {
  const uint64_t to = std::clamp(step, firstStep(), lastStep());
  if (to == shown_) return;
  applyFrame(world(), history_[size_t(to - first_)]);
  shown_ = to;
  rewound_ = true;
}

void Session::advance(double seconds) {
  if (!run_ || paused) return;
  resumeFromShown();
  const double dt = run_->settings().dt;
  due_ = std::min(due_ + seconds * speed, kMaxDue * std::max(1.0, double(speed)));
  const auto start = Clock::now();
  while (due_ >= dt) {
    makeStep();
    due_ -= dt;
    if (std::chrono::duration<double>(Clock::now() - start).count() > kFrameBudget) break;
  }
}

void Session::throwBall(const Vec3& from, const Vec3& velocity, float radius) {
  resumeFromShown();
  touched_ = true;
  world().addBody({.name = "thrown ball " + std::to_string(world().states().size()),
                   .pose = {from, pfx::Quat::Identity()},
                   .linear_velocity = velocity,
                   .shapes = {pfx::Shape{pfx::Sphere{radius}, {}}},
                   .mass = 8000.0f * radius * radius * radius});
  // What was remembered has one body less; it cannot be shown with this world any more.
  history_.clear();
  first_ = shown_;
  remember();
}

}  // namespace viewer
