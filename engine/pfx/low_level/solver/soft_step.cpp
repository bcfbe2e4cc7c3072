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
          .friction_spread = p.friction_spread,
          .restitution_threshold = p.restitution_threshold};
}

uint32_t numLanes(std::span<const ContactConstraint* const> lanes) {
  uint32_t n = 0;
  while (n < lanes.size() && lanes[n]) ++n;
  return n;
}

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

// Impacts of a batch count by the speed where the surfaces meet, not by that at the start of the step: with
// acceleration a and separation s, v'^2 = v^2 - 2 a s.
void measureAtSurface(ContactRows& rows, std::span<const BodyMotion> motions, float threshold) {
  const auto acceleration = [&](int32_t body) -> Vec3 {
    const auto i = static_cast<size_t>(body);
    return i < motions.size() && motions[i].inertia ? motions[i].acceleration : Vec3(Vec3::Zero());
  };
  for (uint32_t i = 0; i < rows.num_points; ++i) {
    ContactPointRows& p = rows.points[i];
    for (int lane = 0; lane < kRowLanes; ++lane) {
      if (!(p.approach_speed[lane] < -threshold)) continue;
      const Vec3 n(rows.normal[0][lane], rows.normal[1][lane], rows.normal[2][lane]);
      const float along = n.dot(acceleration(rows.body_b[lane]) - acceleration(rows.body_a[lane]));
      p.approach_speed[lane] = surfaceSpeed(p.approach_speed[lane], p.separation[lane], along);
    }
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

void SoftStep::prepare(std::span<const ContactConstraint> constraints, std::span<const uint8_t> is_dynamic,
                       std::span<SolverBody> bodies, const SoftStepParams& params, TaskManager& tasks) {
  solve_params_ = makeSolveParams(params);
  links_.clear();
  for (const ContactConstraint& c : constraints) links_.push_back({c.solver_a, c.solver_b});
  colouring_.build(links_, is_dynamic);
  makeBatches(constraints);

  const ContactKernels& kernels = contactKernels(params.simd);
  const uint32_t idle = static_cast<uint32_t>(bodies.size()) - 1;
  tasks.parallelFor(static_cast<uint32_t>(lanes_.size() / kRowLanes), kBatchGrain, [&](TaskRange range) {
    for (uint32_t b = range.begin; b < range.end; ++b) {
      const auto lanes =
          std::span<const ContactConstraint* const>(lanes_).subspan(size_t(b) * kRowLanes, kRowLanes);
      fillContactRows(rows_[b], lanes.first(numLanes(lanes)), idle);
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
  for (size_t b = 0; b < lanes_.size() / kRowLanes; ++b)
    if (rows_[b].has_restitution) measureAtSurface(rows_[b], motions, params.restitution_threshold);
  for (int i = 0; i < params.substeps; ++i) {
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
      const auto lanes =
          std::span<const ContactConstraint* const>(lanes_).subspan(size_t(b) * kRowLanes, kRowLanes);
      storeContactImpulses(rows_[b], lanes.first(numLanes(lanes)));
    }
  });
}

}  // namespace pfx
