#include "pfx/low_level/solver/joint_step.h"

#include <algorithm>

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

void JointStep::clear() {
  components_.clear();
  direct_.clear();
  soft_.clear();
}

void JointStep::add(JointComponent& component) {
  components_.push_back(&component);
  if (!component.is_soft) direct_.push_back(&component);
}

void JointStep::remove(const JointComponent& component) {
  std::erase(components_, &component);
  std::erase(direct_, &component);
}

void JointStep::prepare(std::span<const RigidState> states, std::span<const uint8_t> is_dynamic,
                        std::span<const SolverBody> bodies, const SoftJointParams& params,
                        TaskManager& tasks) {
  for (const JointComponent* c : components_) {
    if (!c->is_soft) continue;
    const auto solver = [&](uint32_t body) {
      const auto at = std::lower_bound(c->bodies.begin(), c->bodies.end(), body);
      return c->solver_index[static_cast<size_t>(at - c->bodies.begin())];
    };
    for (const JointConstraint& j : c->joints)
      soft_.add({.constraint = j, .solver_a = solver(j.body_a), .solver_b = solver(j.body_b)});
  }
  if (!soft_.empty()) soft_.prepare(states, is_dynamic, bodies, params, tasks);
}

void JointStep::start(std::span<SolverBody> bodies, bool first, TaskManager& tasks) {
  if (!soft_.empty()) first ? soft_.warmStart(bodies, tasks) : soft_.follow(bodies, tasks);
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.startSubstep(bodies, c.solver_index); });
}

void JointStep::push(std::span<SolverBody> bodies, TaskManager& tasks) {
  if (!soft_.empty()) soft_.push(bodies, tasks);
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.solvePositions(bodies, c.solver_index); });
}

void JointStep::relax(std::span<SolverBody> bodies, TaskManager& tasks) {
  if (!soft_.empty()) soft_.relax(bodies, tasks);
  forComponents(direct_, tasks, [&](JointComponent& c) { c.direct.solveVelocities(bodies, c.solver_index); });
}

void JointStep::end(std::span<const RigidState> states, TaskManager& tasks) {
  if (!soft_.empty()) soft_.end(states, tasks);
  for (JointComponent* c : direct_) c->direct.end();
}

}  // namespace pfx
