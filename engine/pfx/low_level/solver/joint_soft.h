// Soft joints: components with too many loops for the direct solver, by sequential impulses eight joints
// wide.
//
// The same scheme as for contacts: stiffness tied to the sub-step, a coloured graph, a relax pass. See
// soft_step.h.
#pragma once

#include <span>

#include "pfx/base_level/math/vector_double.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/low_level/island/colouring.h"
#include "pfx/low_level/solver/joint_constraint.h"
#include "pfx/low_level/solver/joint_kernels.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct SoftJointParams {
  float h = 1.0f / 240.0f;  // s, of a sub-step
  int substeps = 4;
  bool warm_start = true;
  SimdLevel simd = SimdLevel::Auto;
};

// One joint to be solved softly. Constraint::body_a and body_b are indices of states.
struct SoftJoint {
  JointConstraint constraint;
  uint32_t solver_a = 0, solver_b = 0;
  uint32_t num_rows = 0;   // for single axes
  bool has_point = false;  // see joint_setup.h; both are set by SoftJoints::add
};

class SoftJoints {
 public:
  void clear() { joints_.clear(); }
  void add(const SoftJoint& joint);
  bool empty() const { return joints_.empty(); }

  // Colours the joints and fills the batches. `bodies` as in SoftStep::prepare.
  void prepare(std::span<const RigidState> states, std::span<const uint8_t> is_dynamic,
               std::span<const SolverBody> bodies, const SoftJointParams& params, TaskManager& tasks);

  void warmStart(std::span<SolverBody> bodies, TaskManager& tasks) {
    run(kernels_->warm_start, bodies, tasks);
  }
  void follow(std::span<SolverBody> bodies, TaskManager& tasks) { run(kernels_->follow, bodies, tasks); }
  void push(std::span<SolverBody> bodies, TaskManager& tasks) { run(kernels_->push, bodies, tasks); }
  void relax(std::span<SolverBody> bodies, TaskManager& tasks) { run(kernels_->relax, bodies, tasks); }

  // Writes forces back to the joints. states: of the start of the step.
  void end(std::span<const RigidState> states, TaskManager& tasks);

 private:
  struct Group {
    uint32_t begin, end;  // batches
    bool serial;          // the lanes of different batches share bodies
  };
  void makeBatches();
  void addGroup(std::span<const uint32_t> links, bool serial);
  void run(JointKernels::Fn kernel, std::span<SolverBody> bodies, TaskManager& tasks);

  SoftJointParams params_;
  JointSolveParams solve_params_ = {};
  const JointKernels* kernels_ = nullptr;
  Vector<SoftJoint> joints_;
  Vector<Link> links_;
  Colouring colouring_;
  Vector<uint32_t> sorted_;
  Vector<const SoftJoint*> lanes_;  // in the order of the batches, null in idle lanes
  Vector<JointBatch> batches_;
  Vector<JointAxisRows> rows_;
  Vector<Group> groups_;
};

}  // namespace pfx
