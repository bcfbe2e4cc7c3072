// What a world tells about its solvers and its broad phase, and how the solvers are set.
#include <algorithm>
#include <stdexcept>

#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

bool haveOneInCommon(std::span<const uint32_t> a, std::span<const uint32_t> b) {  // ascending
  const auto &few = a.size() < b.size() ? a : b, &many = a.size() < b.size() ? b : a;
  return std::any_of(few.begin(), few.end(), [&](uint32_t i) { return std::binary_search(many.begin(), many.end(), i); });
}

}  // namespace

void World::setSolver(const SolverSettings& settings) {
  if (settings.substeps < 1) throw std::invalid_argument("world: substeps must be >= 1");
  impl_->def.substeps = settings.substeps;
  impl_->def.joint_solver = settings.joint_solver;
  impl_->def.contact_solver = settings.contact_solver;
}

void World::setGravity(const Vec3& gravity) {
  if (!gravity.allFinite()) throw std::invalid_argument("world: gravity is not finite");
  if (gravity == impl_->def.gravity) return;
  impl_->def.gravity = gravity;
  for (uint32_t i = 0; i < impl_->store.states.size(); ++i) impl_->wake(i);
  impl_->revivePairs();
}

// Resting bodies are looked at again as well, since pairs depend on who is inside.
void World::setBox(const Vec3& center, const Vec3& extent) {
  if (!center.allFinite() || !extent.allFinite() || !(extent.array() > 0.0f).all())
    throw std::invalid_argument("world: the box must be finite and have a size");
  if (center == impl_->def.center && extent == impl_->def.extent) return;
  impl_->def.center = center;
  impl_->def.extent = extent;
  for (uint32_t i = 0; i < impl_->store.states.size(); ++i) {
    if (!impl_->store.exists(i)) continue;
    impl_->wake(i);
    impl_->hasChanged(i);
  }
  impl_->revivePairs();
}

SolverSettings World::solver() const {
  return {impl_->def.substeps, impl_->def.joint_solver, impl_->def.contact_solver};
}

// The bodies of a solver's task include fixed ones, which are in no island.
IslandSolvers World::islandSolvers(uint32_t index) const {
  impl_->listIslands();
  const auto bodies = impl_->islands.bodies(index);
  IslandSolvers found;
  for (uint32_t i = 0; i < impl_->num_newton_islands; ++i)
    found.newton = found.newton || haveOneInCommon(bodies, impl_->newton_islands[i].bodies);
  for (const JointComponent& c : impl_->joint_components.components()) {
    if (!haveOneInCommon(bodies, c.bodies)) continue;
    found.direct_joints = found.direct_joints || !c.is_soft;
    found.soft_joints = found.soft_joints || c.is_soft;
  }
  return found;
}

std::vector<TreeBox> World::treeBoxes() const {
  std::vector<TreeBox> boxes;
  for (const DynamicTree* tree : {&impl_->tree.restingTree(), &impl_->tree.activeTree()})
    tree->visit([&](const Aabb& bounds, uint32_t level, bool is_leaf) { boxes.push_back({bounds, level, is_leaf}); });
  return boxes;
}

int World::sweepAxis() const {
  return impl_->def.pipeline == Pipeline::Simple ? axisOfLargestVariance(impl_->proxies) : -1;
}

}  // namespace pfx
