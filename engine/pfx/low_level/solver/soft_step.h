// The default contact solver: sub-steps of soft constraints with a relax pass.
//
//   for each sub-step: impacts -> integrate velocities -> [warm start -> settle] -> push -> integrate positions -> relax
//   at the end:        restitution of what joints hold
//
// Impacts are events: each contact that bounces is met at its own time, by the speed where the surfaces meet, and what it
// throws against others meets those in the same sub-step. All of them together, at the end of a step, would stop a row of
// balls that hit each other.
//
// The impulses of the last step are a guess. They balance each other as long as nothing has changed; where a body was
// taken away or set elsewhere, what is left of them may be many times what the other bodies can bear (a light body that
// was squeezed by a heavy one). A guess that would throw a body is forgotten, unless
// joints hold it, which may balance any load.
//
// Contacts are found once a step and followed through the sub-steps by the motion of their bodies. Pushing
// overlap apart adds speed, which relax takes out again, so that positions heal without gaining energy. The
// stiffness is tied to the sub-step, so that the error falls with the square of its length instead of
// stopping at a floor. Source: E. Catto, Solver2D, 2024; M. Macklin et al., Small Steps in Physics
// Simulation, SCA 2019.
#pragma once

#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/integrate/substep.h"
#include "pfx/low_level/island/colouring.h"
#include "pfx/low_level/solver/contact_kernels.h"
#include "pfx/low_level/solver/contact_setup.h"
#include "pfx/low_level/solver/joint_step.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct SoftStepParams {
  float h = 1.0f / 240.0f;  // s, of a sub-step
  int substeps = 4;
  bool warm_start = true;              // start from the impulses in the manifolds
  float contact_frequency = 0.25f;     // of contacts, in units of 1/h; higher: stiffer, less calm
  float contact_damping = 1.0f;        // damping ratio of contacts
  // m/s at which an overlap opens at most. The ends of a row of n bodies inside each other add up to half of n of it.
  float max_push_speed = 0.65f;
  float restitution_threshold = 0.5f;  // m/s
  SimdLevel simd = SimdLevel::Auto;
};

class SoftStep {
 public:
  // Colours the constraints and makes rows of them. `bodies` hold the velocities at the start of the step; dq
  // holds the orientation and dp nothing. The last body is the idle one. is_dynamic: by solver body.
  void prepare(std::span<const ContactConstraint> constraints, std::span<const uint8_t> is_dynamic,
               std::span<SolverBody> bodies, const SoftStepParams& params, TaskManager& tasks);

  // Runs the sub-steps. dp and dq must be zero and identity; afterwards they are the motion of the step.
  void solve(std::span<SolverBody> bodies, std::span<BodyMotion> motions, const SoftStepParams& params,
             JointStep& joints, TaskManager& tasks);

  // Writes the impulses back to the manifolds.
  void store(TaskManager& tasks) const;

  uint32_t numColours() const { return colouring_.size(); }

 private:
  struct Group {
    uint32_t begin, end;  // batches
    bool serial;          // the lanes of different batches share bodies
  };
  void makeBatches(std::span<const ContactConstraint> constraints);
  void giveRollingRows();
  void orderImpacts(std::span<const BodyMotion> motions);
  bool mayBounce(std::span<const SolverBody> bodies, std::span<const BodyMotion> motions, const SoftStepParams& params) const;
  void bounce(const ContactKernels& kernels, std::span<SolverBody> bodies, TaskManager& tasks);
  std::span<const ContactConstraint* const> lanesOf(uint32_t batch) const;
  void warmStart(const ContactKernels& kernels, std::span<SolverBody> bodies, std::span<const BodyMotion> motions,
                 JointStep& joints, TaskManager& tasks);
  bool findMisled(std::span<const SolverBody> bodies, std::span<const BodyMotion> motions, JointStep& joints);
  void forgetMisled();
  void push(const ContactKernels& kernels, std::span<SolverBody> bodies, JointStep& joints, TaskManager& tasks);
  void run(ContactKernels::Fn kernel, std::span<SolverBody> bodies, TaskManager& tasks);

  Colouring colouring_;
  Vector<Link> links_;
  Vector<const ContactConstraint*>
      lanes_;  // constraints in the order of the batches, null in idle lanes
  Vector<ContactRows> rows_;
  Vector<RollingRows> rolling_;
  Vector<uint32_t> rolling_of_;  // by batch: index into rolling_, or none; empty when no contact resists turning
  Vector<Group> groups_;
  Vector<uint8_t> misled_;  // by solver body
  ContactSolveParams solve_params_ = {};
};

}  // namespace pfx
