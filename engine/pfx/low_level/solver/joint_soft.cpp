#include "pfx/low_level/solver/joint_soft.h"

#include <algorithm>
#include <cstring>

#include "pfx/low_level/solver/joint_setup.h"

namespace pfx {
namespace {

constexpr uint32_t kBatchGrain = 16;
constexpr float kFrequency = 0.25f;  // of joints, in units of 1/h
constexpr float kDampingRatio = 1.0f;

Mat3d inverseInertia(const SolverBody& b) {
  const float* m = b.inv_inertia;
  Mat3d out;
  out << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return out;
}

JointSide makeSide(const RigidState& state, const SolverBody& body, bool writable) {
  if (!writable) return {toDouble(state.pose()), 0.0, Mat3d::Zero()};
  return {toDouble(state.pose()), body.inv_mass, inverseInertia(body)};
}

}  // namespace

void SoftJoints::add(const SoftJoint& joint) {
  SoftJoint& j = joints_.emplace_back(joint);
  j.num_rows = numAxisRows(*joint.constraint.joint);
  j.has_point = hasPointPart(*joint.constraint.joint);
}

void SoftJoints::addGroup(std::span<const uint32_t> links, bool serial) {
  // Joints with the same rows go into the same batches, as far as there are enough of them.
  sorted_.assign(links.begin(), links.end());
  const auto shape = [&](uint32_t i) { return 2 * joints_[i].num_rows + (joints_[i].has_point ? 1u : 0u); };
  const auto before = [&](uint32_t a, uint32_t b) { return shape(a) < shape(b); };
  if (!std::is_sorted(sorted_.begin(), sorted_.end(), before))
    std::stable_sort(sorted_.begin(), sorted_.end(), before);
  const uint32_t begin = static_cast<uint32_t>(lanes_.size() / kRowLanes);
  for (uint32_t link : sorted_) {
    lanes_.push_back(&joints_[link]);
    if (serial) lanes_.resize(lanes_.size() + kRowLanes - 1, nullptr);
  }
  lanes_.resize((lanes_.size() + kRowLanes - 1) / kRowLanes * kRowLanes, nullptr);
  groups_.push_back({begin, static_cast<uint32_t>(lanes_.size() / kRowLanes), serial});
}

void SoftJoints::makeBatches() {
  lanes_.clear();
  groups_.clear();
  if (!colouring_.overflow().empty()) addGroup(colouring_.overflow(), true);
  for (uint32_t c = 0; c < colouring_.size(); ++c) addGroup(colouring_.links(c), false);
  batches_.resize(lanes_.size() / kRowLanes);
  uint32_t num_rows = 0;
  for (size_t b = 0; b < batches_.size(); ++b) {
    uint32_t most = 0;
    for (int lane = 0; lane < kRowLanes; ++lane)
      if (const SoftJoint* j = lanes_[b * kRowLanes + lane]) most = std::max(most, j->num_rows);
    batches_[b].first_row = num_rows;
    batches_[b].num_rows = most;
    num_rows += most;
  }
  rows_.resize(num_rows);
}

void SoftJoints::prepare(std::span<const RigidState> states, std::span<const uint8_t> is_dynamic,
                         std::span<const SolverBody> bodies, const SoftJointParams& params,
                         TaskManager& tasks) {
  params_ = params;
  kernels_ = &jointKernels(params.simd);
  solve_params_ = {makeSoftness(kFrequency / params.h, kDampingRatio, params.h), 1.0f / params.h};
  links_.clear();
  for (const SoftJoint& j : joints_) links_.push_back({j.solver_a, j.solver_b});
  colouring_.build(links_, is_dynamic);
  makeBatches();
  const int32_t idle = static_cast<int32_t>(bodies.size()) - 1;
  tasks.parallelFor(static_cast<uint32_t>(batches_.size()), kBatchGrain, [&](TaskRange range) {
    for (uint32_t b = range.begin; b < range.end; ++b) {
      const uint32_t first_row = batches_[b].first_row, num_rows = batches_[b].num_rows;
      JointBatch& batch = batches_[b] = {};
      batch.first_row = first_row, batch.num_rows = num_rows;
      const auto rows = std::span(rows_).subspan(first_row, num_rows);
      if (num_rows > 0) std::memset(static_cast<void*>(rows.data()), 0, rows.size_bytes());
      for (int lane = 0; lane < kRowLanes; ++lane) {
        const SoftJoint* j = lanes_[size_t(b) * kRowLanes + lane];
        batch.body_a[lane] = j ? static_cast<int32_t>(j->solver_a) : idle;
        batch.body_b[lane] = j ? static_cast<int32_t>(j->solver_b) : idle;
        if (!j) continue;
        const JointConstraint& c = j->constraint;
        batch.writable_a |= uint32_t(c.writable_a) << lane;
        batch.writable_b |= uint32_t(c.writable_b) << lane;
        fillJointLane(*c.joint, makeSide(states[c.body_a], bodies[j->solver_a], c.writable_a),
                      makeSide(states[c.body_b], bodies[j->solver_b], c.writable_b), params.h,
                      params.warm_start, {batch, rows, lane});
      }
    }
  });
}

void SoftJoints::run(JointKernels::Fn kernel, std::span<SolverBody> bodies, TaskManager& tasks) {
  for (const Group& g : groups_) {
    const uint32_t count = g.end - g.begin;
    const auto work = [&](TaskRange r) {
      kernel(&batches_[g.begin + r.begin], r.end - r.begin, rows_.data(), bodies.data(), solve_params_);
    };
    if (g.serial)
      work({0, count, 0});
    else
      tasks.parallelFor(count, kBatchGrain, work);
  }
}

void SoftJoints::end(std::span<const RigidState> states, TaskManager& tasks) {
  tasks.parallelFor(static_cast<uint32_t>(batches_.size()), kBatchGrain, [&](TaskRange range) {
    for (uint32_t b = range.begin; b < range.end; ++b) {
      JointBatch& batch = batches_[b];
      const auto rows = std::span(rows_).subspan(batch.first_row, batch.num_rows);
      for (int lane = 0; lane < kRowLanes; ++lane) {
        const SoftJoint* j = lanes_[size_t(b) * kRowLanes + lane];
        if (j)
          storeJointForces({batch, rows, lane}, states[j->constraint.body_a], params_.h,
                           *j->constraint.joint);
      }
    }
  });
}

}  // namespace pfx
