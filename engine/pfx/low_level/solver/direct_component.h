// The direct joint solver for one component: bodies that joints link, solved together.
//
// All joints are held at once by a block-sparse L D L^T of J M^-1 J^T, so that neither the ratio of the
// masses nor the length of a chain limits how well they hold. Alone, a component takes leapfrog sub-steps, of
// second order:
//
//   half a kick, [hold the positions at the end of the sub-step, move, kick] ..., half a kick, hold the
//   velocities
//
// Together with contacts, the sub-step loop of soft_step.h calls solvePositions and solveVelocities instead.
// Sources: D. Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996; H. Andersen, Rattle, J.
// Comp. Phys. 52, 1983; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2006, section
// VII.1.
#pragma once

#include <span>

#include "pfx/base_level/constraint/solver_body.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/solver/direct_rows.h"
#include "pfx/low_level/solver/direct_structure.h"
#include "pfx/low_level/solver/joint_constraint.h"

namespace pfx {

struct DirectStepParams {
  double h = 1.0 / 240.0;  // s, of a sub-step
  int substeps = 4;
  bool warm_start = true;
};

class DirectComponent {
 public:
  // Symbolic part. False when a factor would need more than max_products block products.
  bool build(std::span<const JointConstraint> joints, uint64_t max_products);

  // Indices of states, in local order.
  std::span<const uint32_t> bodies() const { return body_index_; }
  uint32_t numJoints() const { return static_cast<uint32_t>(joints_.size()); }
  std::span<DirectJoint> joints() { return joints_; }  // which rows act is remembered from step to step

  // Loads the bodies at the start of a step; motions: by local body, inertia null where joints do not move
  // it.
  void begin(std::span<const RigidState> states, std::span<const RigidBody> bodies,
             std::span<const BodyMotion> motions, const DirectStepParams& params);

  // The whole step of a component without contacts. Writes the states of its dynamic bodies.
  void advance(std::span<RigidState> states);

  // One part of a sub-step together with contacts. solver_index: solver body by local body.
  // startSubstep puts the joints' impulses of the last sub-step, which the bodies remember, along today's
  // levers.
  void startSubstep(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index);
  void solvePositions(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index);
  void solveVelocities(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index);

  // Writes what the joints report: forces of the axes, force and torque of the step.
  void end();

 private:
  void linearize(const DirectSubstep& s);
  void factor(double regularization);
  void solve();
  double fillResiduals(const DirectSubstep& s, bool velocity_only);
  void applySolution();
  void takeBackSolution();
  double regularization() const;
  void predictAll(double h);
  bool update(bool velocity_only, bool first);
  void holdPositions(const DirectSubstep& s);
  void holdVelocities(const DirectSubstep& s);
  void startFrom(double part);
  void rememberForces(double part);
  void sumImpulses();
  void load(std::span<const SolverBody> bodies, std::span<const uint32_t> solver_index);
  void store(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index);

  DirectStepParams params_;
  Vector<DirectJoint> joints_;
  Vector<DirectBody> bodies_;
  Vector<TransformDouble> start_;  // poses at the start of the step
  Vector<uint32_t> body_index_;
  DirectStructure structure_;
  int block_ = 3;                   // rows of a block: 3, 5 or 6
  bool closed_ = false;             // loops, or held at several places: rows may depend on each other
  bool redundant_ = false;          // they do
  bool stiff_ = false;              // sub-steps are damped, see stiffnessRatio
  bool started_ = false;            // a sub-step of this step has begun
  bool linearized_ = false;         // at the poses of the bodies, factor included
  Vector<uint32_t> position_;  // in the order of elimination, by joint
  Vector<double> diagonal_, off_diagonal_, scratch_, x_;
};

}  // namespace pfx
