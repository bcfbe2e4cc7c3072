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

// Joints and contacts take turns, so that a direct solve sees what the contacts of its bodies did. One turn
// is enough for either of them alone.
void SoftStep::push(const ContactKernels& kernels, std::span<SolverBody> bodies, JointStep& joints,
                    TaskManager& tasks) {
  if (joints.empty()) return run(kernels.push, bodies, tasks);
  const int turns = lanes_.empty() ? 1 : 2;
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
    if (i == 0 && params.warm_start) run(kernels.warm_start, bodies, tasks);
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
