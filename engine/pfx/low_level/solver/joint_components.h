// Components of the joint graph, and which solver each of them gets.
//
// A component is the set of joints that movable bodies link. Trees and graphs with few loops are solved
// directly; where loops would fill the factor, joints become soft rows instead. Made anew only when joints
// or the choice of the solver change.
#pragma once

#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/island/islands.h"
#include "pfx/low_level/solver/direct_component.h"
#include "pfx/low_level/solver/joint_constraint.h"

namespace pfx {

struct JointComponent {
  bool is_direct = false;  // has a factor
  bool is_soft = true;     // in this step
  bool has_gears = false;
  DirectComponent direct;  // when is_direct
  Vector<JointConstraint> joints;
  Vector<uint32_t> bodies;        // indices of states, ascending, movable or not
  Vector<uint32_t> solver_index;  // by entry of bodies; while it is solved together with contacts
  Vector<BodyMotion> motions;     // by entry of bodies
};

class JointComponents {
 public:
  // Brings the components up to date. Returns whether they changed. num_bodies: of all states.
  bool update(std::span<const JointConstraint> joints, uint32_t num_bodies, JointSolver solver);
  Deque<JointComponent>& components() { return components_; }
  // joint: index into those of the last update.
  JointComponent& componentOf(uint32_t joint) { return components_[component_of_[joint]]; }

 private:
  void addComponent(std::span<const uint32_t> joints, JointSolver solver);

  JointSolver solver_ = JointSolver::Auto;
  Vector<JointConstraint> joints_;
  Vector<uint32_t> rows_;  // which axes each joint constrains, and how
  Islands islands_;
  Vector<uint32_t> component_of_;  // by joint
  Deque<JointComponent> components_;
};

}  // namespace pfx
