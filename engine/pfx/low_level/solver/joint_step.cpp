#include "pfx/low_level/solver/joint_step.h"

namespace pfx {
namespace {

// Components share no movable body, so that they can be solved at the same time.
template <class Fn>
void forComponents(std::span<JointComponent* const> components, TaskManager& tasks, Fn&& fn) {
  tasks.parallelFor(static_cast<uint32_t>(components.size()), 1, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) fn(*components[i]);
  });
}

}  // namespace

void JointStep::warmStart(std::span<SolverBody> bodies, TaskManager& tasks) {
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.applyWarmStart(bodies, c.solver_index); });
}

void JointStep::push(std::span<SolverBody> bodies, TaskManager& tasks) {
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.solvePositions(bodies, c.solver_index); });
}

void JointStep::relax(std::span<SolverBody> bodies, TaskManager& tasks) {
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.solveVelocities(bodies, c.solver_index); });
}

void JointStep::end() {
  for (JointComponent* c : direct_) c->direct.end();
}

}  // namespace pfx
