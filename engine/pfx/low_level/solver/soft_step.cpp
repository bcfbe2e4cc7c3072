#include "pfx/low_level/solver/soft_step.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

constexpr uint32_t kBatchGrain = 16;  // batches a task; less is not worth sharing out
constexpr uint32_t kBodyGrain = 128;

ContactSolveParams makeSolveParams(const SoftStepParams& p) {
  const float f = p.contact_frequency / p.h;
  return {.inv_h = 1.0f / p.h,
          .moving = makeSoftness(f, p.contact_damping, p.h),
          .fixed = makeSoftness(2.0f * f, p.contact_damping, p.h),
          .max_push_speed = p.max_push_speed,
          .restitution_threshold = p.restitution_threshold};
}

constexpr uint32_t kNoRolling = 0xffffffffu;

template <class Fn>
void forBodies(std::span<SolverBody> bodies, std::span<BodyMotion> motions, TaskManager& tasks, Fn&& fn) {
  tasks.parallelFor(static_cast<uint32_t>(motions.size()), kBodyGrain, [&](TaskRange r) {
    const size_t n = r.end - r.begin;
    fn(bodies.subspan(r.begin, n), motions.subspan(r.begin, n));
  });
}

float surfaceSpeed(float approach, float separation, float acceleration) {
  return -std::sqrt(std::max(approach * approach - 2.0f * acceleration * separation, 0.0f));
}

// Impacts that a body may have in a sub-step. Between bodies that are pressed together they have no end.
constexpr int kMostImpacts = 8;

// Rounds in which guesses are forgotten; whatever still throws a body then goes with all others.
constexpr int kMostRounds = 4;

// A guess may change the velocity of a body by this many times what the body has, and by this speed (m/s) besides.
constexpr float kMostGain = 2.0f, kMostSpeed = 5.0f;

Vec3 vectorOf(const float (&a)[3]) { return Vec3(a[0], a[1], a[2]); }

// Angular velocity before the impulses.
Vec3 freeSpin(const SolverBody& b, const BodyMotion& m) {
  const float* i = b.inv_inertia;
  const Vec3& l = m.free_momentum;
  return Vec3(i[0] * l.x() + i[1] * l.y() + i[2] * l.z(), i[1] * l.x() + i[3] * l.y() + i[4] * l.z(),
              i[2] * l.x() + i[4] * l.y() + i[5] * l.z());
}

bool isMisled(const SolverBody& b, const BodyMotion& m) {
  if (!m.inertia) return false;
  if (!((vectorOf(b.v) - m.free_velocity).norm() <= kMostSpeed + kMostGain * m.free_velocity.norm())) return true;
  const Vec3 spin = freeSpin(b, m);
  const float radius = std::sqrt(m.inertia->body.trace() / 3.0f * b.inv_mass);
  return !(radius * (vectorOf(b.w) - spin).norm() <= kMostSpeed + kMostGain * radius * spin.norm());
}

void takeBackGuess(std::span<SolverBody> bodies, std::span<const BodyMotion> motions) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (!motions[i].inertia) continue;
    const Vec3 spin = freeSpin(bodies[i], motions[i]);
    for (int k = 0; k < 3; ++k) bodies[i].v[k] = motions[i].free_velocity[k], bodies[i].w[k] = spin[k];
  }
}

// Acceleration along the normal of a lane.
float fallOf(const ContactRows& rows, int lane, std::span<const BodyMotion> motions) {
  const auto acceleration = [&](int32_t body) -> Vec3 {
    const auto i = static_cast<size_t>(body);
    return i < motions.size() && motions[i].inertia ? motions[i].acceleration : Vec3(Vec3::Zero());
  };
  const Vec3 n(rows.normal[0][lane], rows.normal[1][lane], rows.normal[2][lane]);
  return n.dot(acceleration(rows.body_b[lane]) - acceleration(rows.body_a[lane]));
}

// Impacts that count at the end of the step do so by the speed where the surfaces meet, not by that at its start.
void measureAtSurface(ContactRows& rows, int lane, float fall) {
  for (uint32_t i = 0; i < rows.num_points; ++i) {
    ContactPointRows& p = rows.points[i];
    if (p.approach_speed[lane] < 0.0f)
      p.approach_speed[lane] = surfaceSpeed(p.approach_speed[lane], p.separation[lane], fall);
  }
}

}  // namespace

void SoftStep::makeBatches(std::span<const ContactConstraint> constraints) {
  lanes_.clear();
  groups_.clear();
  const auto addGroup = [&](std::span<const uint32_t> links, bool serial) {
    const uint32_t begin = static_cast<uint32_t>(lanes_.size() / kRowLanes);
    for (uint32_t link : links) {
      lanes_.push_back(&constraints[link]);
      // Overflow constraints may share bodies: one lane a batch, one batch after the other.
      if (serial) lanes_.resize(lanes_.size() + kRowLanes - 1, nullptr);
    }
    lanes_.resize((lanes_.size() + kRowLanes - 1) / kRowLanes * kRowLanes, nullptr);
    groups_.push_back({begin, static_cast<uint32_t>(lanes_.size() / kRowLanes), serial});
  };
  if (!colouring_.overflow().empty()) addGroup(colouring_.overflow(), true);
  for (uint32_t c = 0; c < colouring_.size(); ++c) addGroup(colouring_.links(c), false);
  if (rows_.size() < lanes_.size() / kRowLanes) rows_.resize(lanes_.size() / kRowLanes);
}

std::span<const ContactConstraint* const> SoftStep::lanesOf(uint32_t batch) const {
  const auto lanes = std::span(lanes_).subspan(size_t(batch) * kRowLanes, kRowLanes);
  size_t n = 0;
  while (n < lanes.size() && lanes[n]) ++n;
  return lanes.first(n);
}

void SoftStep::giveRollingRows() {
  uint32_t count = 0;
  rolling_of_.assign(lanes_.size() / kRowLanes, kNoRolling);
  for (uint32_t b = 0; b < rolling_of_.size(); ++b)
    if (std::ranges::any_of(lanesOf(b), [](const ContactConstraint* c) { return resistsTurning(*c); }))
      rolling_of_[b] = count++;
  if (rolling_.size() < count) rolling_.resize(count);
}

void SoftStep::prepare(std::span<const ContactConstraint> constraints, std::span<const uint8_t> is_dynamic,
                       std::span<SolverBody> bodies, const SoftStepParams& params, TaskManager& tasks) {
  solve_params_ = makeSolveParams(params);
  links_.clear();
  bool any_rolling = false;
  for (const ContactConstraint& c : constraints) {
    links_.push_back({c.solver_a, c.solver_b});
    any_rolling |= resistsTurning(c);
  }
  colouring_.build(links_, is_dynamic);
  makeBatches(constraints);
  rolling_of_.clear();
  if (any_rolling) giveRollingRows();

  const ContactKernels& kernels = contactKernels(params.simd);
  const uint32_t idle = static_cast<uint32_t>(bodies.size()) - 1;
  tasks.parallelFor(static_cast<uint32_t>(lanes_.size() / kRowLanes), kBatchGrain, [&](TaskRange range) {
    for (uint32_t b = range.begin; b < range.end; ++b) {
      fillContactRows(rows_[b], lanesOf(b), idle);
      if (rolling_of_.empty() || rolling_of_[b] == kNoRolling) continue;
      rows_[b].rolling = &rolling_[rolling_of_[b]];
      fillRollingRows(*rows_[b].rolling, lanesOf(b));
    }
    kernels.prepare(&rows_[range.begin], range.end - range.begin, bodies.data(), solve_params_);
  });
}

void SoftStep::run(ContactKernels::Fn kernel, std::span<SolverBody> bodies, TaskManager& tasks) {
  for (const Group& g : groups_) {
    const uint32_t count = g.end - g.begin;
    const auto work = [&](TaskRange r) {
      kernel(&rows_[g.begin + r.begin], r.end - r.begin, bodies.data(), solve_params_);
    };
    if (g.serial)
      work({0, count, 0});
    else
      tasks.parallelFor(count, kBatchGrain, work);
  }
}

bool SoftStep::findMisled(std::span<const SolverBody> bodies, std::span<const BodyMotion> motions,
                          JointStep& joints) {
  misled_.assign(bodies.size(), 0);
  for (size_t i = 0; i < motions.size(); ++i) misled_[i] = isMisled(bodies[i], motions[i]);
  for (const JointComponent* c : joints.components())
    for (uint32_t i : c->solver_index) misled_[i] = 0;
  return std::find(misled_.begin(), misled_.end(), uint8_t{1}) != misled_.end();
}

void SoftStep::forgetMisled() {
  for (size_t b = 0; b < lanes_.size() / kRowLanes; ++b) {
    ContactRows& rows = rows_[b];
    for (int lane = 0; lane < kRowLanes; ++lane) {
      if (!misled_[static_cast<size_t>(rows.body_a[lane])] && !misled_[static_cast<size_t>(rows.body_b[lane])]) continue;
      for (uint32_t i = 0; i < rows.num_points; ++i) {
        ContactPointRows& p = rows.points[i];
        p.normal_impulse[lane] = p.tangent_impulse[0][lane] = p.tangent_impulse[1][lane] = 0.0f;
      }
    }
  }
}

void SoftStep::orderImpacts(std::span<const BodyMotion> motions) {
  const auto is_jointed = [&](int32_t body) {
    const auto i = static_cast<size_t>(body);
    return i < motions.size() && motions[i].inertia && !motions[i].keeps_pace;
  };
  for (size_t b = 0; b < lanes_.size() / kRowLanes; ++b) {
    ContactRows& rows = rows_[b];
    for (int lane = 0; rows.has_restitution && lane < kRowLanes; ++lane) {
      if (!(rows.restitution[lane] > 0.0f)) continue;
      const float fall = fallOf(rows, lane, motions);
      if (is_jointed(rows.body_a[lane]) || is_jointed(rows.body_b[lane])) {
        measureAtSurface(rows, lane, fall);
        continue;
      }
      rows.bounces_in_order |= 1u << lane;
      rows.fall[lane] = fall;
      for (uint32_t i = 0; i < rows.num_points; ++i) rows.points[i].approach_speed[lane] = 0.0f;
    }
  }
}

// Whether any two bodies may come to meet faster than the threshold, and bounce.
bool SoftStep::mayBounce(std::span<const SolverBody> bodies, std::span<const BodyMotion> motions,
                         const SoftStepParams& params) const {
  const auto batches = std::span(rows_).first(lanes_.size() / kRowLanes);
  if (std::ranges::none_of(batches, [](const ContactRows& r) { return r.has_restitution != 0; })) return false;
  const float dt = params.h * static_cast<float>(params.substeps);
  for (size_t i = 0; i < motions.size(); ++i) {
    const SolverBody& b = bodies[i];
    const float spin = motions[i].inertia ? std::sqrt(motions[i].inertia->body.trace() * b.inv_mass) : 0.0f;
    const float speed = vectorOf(b.v).norm() + 2.0f * spin * vectorOf(b.w).norm() + dt * motions[i].acceleration.norm();
    if (!motions[i].inertia ? vectorOf(b.w).squaredNorm() + vectorOf(b.v).squaredNorm() > 0.0f
                            : speed > 0.5f * params.restitution_threshold)
      return true;
  }
  return false;
}

void SoftStep::bounce(const ContactKernels& kernels, std::span<SolverBody> bodies, TaskManager& tasks) {
  const auto batches = std::span(rows_).first(lanes_.size() / kRowLanes);
  for (int i = 0; i < kMostImpacts; ++i) {
    run(kernels.bounce, bodies, tasks);
    if (std::ranges::none_of(batches, [](const ContactRows& r) { return r.has_bounced != 0; })) return;
  }
}

void SoftStep::warmStart(const ContactKernels& kernels, std::span<SolverBody> bodies,
                         std::span<const BodyMotion> motions, JointStep& joints, TaskManager& tasks) {
  run(kernels.warm_start, bodies, tasks);
  for (int round = 0; findMisled(bodies, motions, joints); ++round) {
    if (round == kMostRounds) std::fill(misled_.begin(), misled_.end(), uint8_t{1});
    forgetMisled();
    takeBackGuess(bodies.first(motions.size()), motions);
    if (round == kMostRounds) return;
    run(kernels.warm_start, bodies, tasks);
  }
}

// Joints and contacts take turns, so that a direct solve sees what the contacts of its bodies did. One turn
// is enough for either of them alone.
void SoftStep::push(const ContactKernels& kernels, std::span<SolverBody> bodies, JointStep& joints,
                    TaskManager& tasks) {
  if (joints.empty()) return run(kernels.push, bodies, tasks);
  const int turns = lanes_.empty() ? 1 : 4;
  for (int turn = 0; turn < turns; ++turn) {
    joints.push(bodies, tasks);
    run(kernels.push, bodies, tasks);
  }
}

void SoftStep::solve(std::span<SolverBody> bodies, std::span<BodyMotion> motions,
                     const SoftStepParams& params, JointStep& joints, TaskManager& tasks) {
  const ContactKernels& kernels = contactKernels(params.simd);
  const bool may_bounce = mayBounce(bodies.first(motions.size()), motions, params);
  if (may_bounce)
    orderImpacts(motions);
  else
    for (size_t b = 0; b < lanes_.size() / kRowLanes; ++b) rows_[b].has_restitution = 0;
  for (int i = 0; i < params.substeps; ++i) {
    if (may_bounce) bounce(kernels, bodies, tasks);
    forBodies(bodies, motions, tasks, [&](auto b, auto m) { integrateVelocities(b, m, params.h); });
    if (i == 0 && params.warm_start) warmStart(kernels, bodies, motions, joints, tasks);
    // not with joints, whose share of the load nobody knows yet
    if (i == 0 && joints.empty()) run(kernels.settle, bodies, tasks);
    forBodies(bodies, motions, tasks, [&](auto b, auto m) { setLag(b, m, params.h); });
    if (!joints.empty()) joints.start(bodies, i == 0, tasks);
    push(kernels, bodies, joints, tasks);
    forBodies(bodies, motions, tasks, [&](auto b, auto m) { integratePositions(b, m, params.h); });
    run(kernels.relax, bodies, tasks);
    if (!joints.empty()) joints.relax(bodies, tasks);
    if (i + 1 < params.substeps)
      forBodies(bodies, motions, tasks, [](auto b, auto m) { rememberImpulses(b, m); });
  }
  run(kernels.restitution, bodies, tasks);
}

void SoftStep::store(TaskManager& tasks) const {
  tasks.parallelFor(static_cast<uint32_t>(lanes_.size() / kRowLanes), kBatchGrain, [&](TaskRange range) {
    for (uint32_t b = range.begin; b < range.end; ++b) {
      storeContactImpulses(rows_[b], lanesOf(b));
    }
  });
}

}  // namespace pfx
