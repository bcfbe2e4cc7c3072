// The joints' part of the sub-step loop: components that are solved together with contacts.
#pragma once

#include <span>
#include <vector>

#include "pfx/low_level/solver/joint_components.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

class JointStep {
 public:
  void clear() { direct_.clear(); }
  void add(JointComponent& component) { direct_.push_back(&component); }
  std::span<JointComponent* const> components() { return direct_; }
  bool empty() const { return direct_.empty(); }

  // For each sub-step: [warm start] -> push, as often as contacts are pushed -> (motion) -> relax.
  void warmStart(std::span<SolverBody> bodies, TaskManager& tasks);
  void push(std::span<SolverBody> bodies, TaskManager& tasks);
  void relax(std::span<SolverBody> bodies, TaskManager& tasks);

  // Writes forces back to the joints.
  void end();

 private:
  std::vector<JointComponent*> direct_;
};

}  // namespace pfx
