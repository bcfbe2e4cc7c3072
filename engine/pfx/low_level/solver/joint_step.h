// The joints' part of the sub-step loop: components that are solved together with contacts, and soft joints.
#pragma once

#include <algorithm>
#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/solver/joint_components.h"
#include "pfx/low_level/solver/joint_soft.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

class JointStep {
 public:
  void clear();
  void add(JointComponent& component);
  void remove(const JointComponent& component);
  bool empty() const { return components_.empty(); }
  bool hasSoftGears() const {
    return std::ranges::any_of(components_, [](const JointComponent* c) { return c->is_soft && c->has_gears; });
  }
  std::span<JointComponent* const> components() { return components_; }

  // Takes over what the components need of the step; solver_index of the components is set, and direct
  // components have begun. `bodies` as in SoftStep::prepare.
  void prepare(std::span<const RigidState> states, std::span<const uint8_t> is_dynamic,
               std::span<const SolverBody> bodies, const SoftJointParams& params, TaskManager& tasks);

  // For each sub-step: start -> push, as often as contacts are pushed -> (motion) -> relax.
  void start(std::span<SolverBody> bodies, bool first, TaskManager& tasks);
  void push(std::span<SolverBody> bodies, TaskManager& tasks);
  void relax(std::span<SolverBody> bodies, TaskManager& tasks);

  // Writes forces back to the joints; states still of the start of the step.
  void end(std::span<const RigidState> states, TaskManager& tasks);

 private:
  Vector<JointComponent*> components_;
  Vector<JointComponent*> direct_;
  SoftJoints soft_;
};

}  // namespace pfx
