// Islands that the island solver takes: which, and their step.
//
// Sequential impulses carry a load through a stack one contact a sweep, and lose it where it is many times
// what the lighter body weighs: low in a tall stack, under something heavy. They let slip what only holds
// while nothing gives way: stones of an arch, cards that lean. Each contact tells by its impulse, masses and
// normal whether it is of that kind, so that a world in which nothing is strained pays for a comparison a
// manifold. Where bodies were set upon each other nobody knows the loads yet; a structure of which that is true throughout
// is strained until its first step has told them.
#include <algorithm>
#include <cmath>

#include "pfx/high_level/pipeline/restitution_threshold.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

// Bodies of an island; the factor of a larger one costs more than it gains. Heaps lean too, and sequential
// impulses do well enough with those that are no structure of a few parts.
constexpr size_t kMostBodies = 128;
constexpr size_t kMostLeaningBodies = 48;

// Bodies of all islands of a step. A crowd of stacks is left to the sequential impulses as a whole: 196 pyramids of 55
// boxes took seconds a step.
constexpr size_t kMostBodiesInAll = 300;

// A contact is strained when it carries this many times the weight of its lighter body, or when the body on
// top is this many times as heavy. It leans when its normal is farther from the vertical than this (cosine).
constexpr float kLoad = 5.0f;
constexpr float kMassRatio = 20.0f;
constexpr float kLeaning = 0.95f;

// Contacts between bodies that move against each other by less than this (in sub-steps of free fall) are at
// rest. An island needs this share of them: what tumbles is nothing to hold up.
constexpr float kRestingFall = 8.0f;
constexpr double kRestingShare = 0.75;

float fallSpeed(const World::Impl& w) {
  return w.def.gravity.norm() * w.dt / static_cast<float>(w.def.substeps);
}

bool isResting(const World::Impl& w, const ContactConstraint& c) {
  const float most = kRestingFall * fallSpeed(w);
  return (w.store.states[c.solver_b].linear_velocity - w.store.states[c.solver_a].linear_velocity)
             .squaredNorm() < most * most;
}

float totalImpulse(const ContactManifold& m) {
  float sum = 0.0f;
  for (int i = 0; i < m.num_points; ++i) sum += m.points[i].normal_impulse;
  return sum;
}

bool leans(const World::Impl& w, const ContactConstraint& c) {
  return std::abs(c.manifold->normal.dot(w.def.gravity)) < kLeaning * w.def.gravity.norm();
}

bool isTopHeavy(const World::Impl& w, const ContactConstraint& c) {
  const float mass_a = w.store.bodies[c.solver_a].mass, mass_b = w.store.bodies[c.solver_b].mass;
  const bool b_is_above = c.manifold->normal.dot(w.def.gravity) < 0.0f;
  return !leans(w, c) && (b_is_above ? mass_b > kMassRatio * mass_a : mass_a > kMassRatio * mass_b);
}

NewtonParams newtonParams(const World::Impl& w) {
  return {.h = static_cast<double>(w.dt) / w.def.substeps,
          .substeps = w.def.substeps,
          .restitution_threshold = stage::restitutionThreshold(w)};
}

// Whether every body that a constraint could move is moved by it, and none has a surface that moves by itself
// or resists turning.
bool isSymmetric(const World::Impl& w, const ContactConstraint& c) {
  const auto is_plain = [&](uint32_t body) { return w.motionOf(body) == nullptr && w.beltOf(body) == nullptr; };
  return is_plain(c.solver_a) && is_plain(c.solver_b) && !resistsTurning(c) &&
         c.writable_a == isDynamic(w.store.states[c.solver_a].motion_type) &&
         c.writable_b == isDynamic(w.store.states[c.solver_b].motion_type);
}

bool isAskedFor(const World::Impl& w, uint32_t island) {
  if (w.def.contact_solver == ContactSolver::Newton) return true;
  const auto links = w.contact_islands.links(island);
  size_t resting = 0;
  const bool may_lean = w.contact_islands.bodies(island).size() <= kMostLeaningBodies;
  bool loaded = false, leaning = false, set_up = true, some_load = false;
  for (uint32_t i : links) {
    const ContactConstraint& c = w.constraints[i];
    resting += isResting(w, c);
    const bool is_fresh = totalImpulse(*c.manifold) == 0.0f;
    set_up = set_up && is_fresh;
    some_load = some_load || c.strain == ContactStrain::Loaded;
    loaded = loaded || (c.strain == ContactStrain::Loaded && (!is_fresh || isTopHeavy(w, c)));
    leaning = leaning || (may_lean && c.strain == ContactStrain::Leaning);
  }
  return (loaded || leaning || (set_up && some_load)) &&
         static_cast<double>(resting) >= kRestingShare * static_cast<double>(links.size());
}

bool isEligible(const World::Impl& w, uint32_t island) {
  const auto links = w.contact_islands.links(island);
  if (links.empty() || links.back() >= w.constraints.size()) return false;  // the last ones are joints
  if (w.contact_islands.bodies(island).size() > kMostBodies) return false;
  return std::all_of(links.begin(), links.end(),
                     [&](uint32_t i) { return isSymmetric(w, w.constraints[i]); }) &&
         isAskedFor(w, island);
}

bool areTooMany(const World::Impl& w) {
  if (w.def.contact_solver == ContactSolver::Newton) return false;
  size_t bodies = 0;
  for (uint32_t k = 0; k < w.contact_islands.size() && bodies <= kMostBodiesInAll; ++k)
    if (isEligible(w, k)) bodies += w.contact_islands.bodies(k).size();
  return bodies > kMostBodiesInAll;
}

void take(World::Impl& w, uint32_t island) {
  if (w.newton_islands.size() == w.num_newton_islands) w.newton_islands.emplace_back();
  NewtonTask& task = w.newton_islands[w.num_newton_islands++];
  task.bodies.clear(), task.motions.clear(), task.constraints.clear();
  for (uint32_t i : w.contact_islands.links(island)) {
    ContactConstraint& c = w.constraints[i];
    task.constraints.push_back(c);
    task.bodies.insert(task.bodies.end(), {c.solver_a, c.solver_b});
    c.manifold = nullptr;  // taken
  }
  std::sort(task.bodies.begin(), task.bodies.end());
  task.bodies.erase(std::unique(task.bodies.begin(), task.bodies.end()), task.bodies.end());
  for (uint32_t i : task.bodies)
    task.motions.push_back(stage::makeMotion(w, i, w.dt / static_cast<float>(w.def.substeps)));
}

void listSolvedAgain(World::Impl& w) {
  std::erase_if(w.constraints, [](const ContactConstraint& c) { return c.manifold == nullptr; });
  for (uint32_t i : w.solved) w.solver_index[i] = kNoSolverBody;
  w.solved.clear();
  for (const ContactConstraint& c : w.constraints) w.needSolverBody(c.solver_a), w.needSolverBody(c.solver_b);
  for (const JointComponent* c : w.joint_step.components())
    for (uint32_t i : c->bodies) w.needSolverBody(i);
}

// To the sequential impulses.
void giveBack(World::Impl& w, const NewtonTask& task) {
  w.constraints.insert(w.constraints.end(), task.constraints.begin(), task.constraints.end());
  for (const ContactConstraint& c : task.constraints) w.needSolverBody(c.solver_a), w.needSolverBody(c.solver_b);
}

}  // namespace

ContactStrain World::Impl::strainOf(const ContactConstraint& c) const {
  if (!c.writable_a || !c.writable_b || def.gravity.isZero()) return ContactStrain::None;
  const float lighter = std::min(store.bodies[c.solver_a].mass, store.bodies[c.solver_b].mass);
  const float impulse = totalImpulse(*c.manifold);
  if (impulse > kLoad * lighter * fallSpeed(*this) || isTopHeavy(*this, c)) return ContactStrain::Loaded;
  if (leans(*this, c)) return c.round_a || c.round_b ? ContactStrain::None : ContactStrain::Leaning;
  return impulse == 0.0f && isResting(*this, c) ? ContactStrain::Loaded : ContactStrain::None;
}

namespace stage {

void chooseSolvers(World::Impl& w) {
  w.island_links.clear();
  for (const ContactConstraint& c : w.constraints) w.island_links.push_back({c.solver_a, c.solver_b});
  for (const JointConstraint& j : w.joint_constraints) w.island_links.push_back({j.body_a, j.body_b});
  w.contact_islands.build(static_cast<uint32_t>(w.store.states.size()), w.active, w.island_links);
  if (areTooMany(w)) return;
  const uint32_t before = w.num_newton_islands;
  for (uint32_t k = 0; k < w.contact_islands.size(); ++k)
    if (isEligible(w, k)) take(w, k);
  if (w.num_newton_islands > before) listSolvedAgain(w);
}

void solveNewtonIslands(World::Impl& w) {
  const NewtonParams params = newtonParams(w);
  w.tasks.parallelFor(w.num_newton_islands, 1, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) {
      NewtonTask& t = w.newton_islands[i];
      t.solver.begin(w.store.states, w.store.bodies, t.bodies, t.motions, t.constraints, params);
      t.is_solved = t.solver.advance(w.store.states);
    }
  });
  for (uint32_t i = 0; i < w.num_newton_islands; ++i)
    if (!w.newton_islands[i].is_solved) giveBack(w, w.newton_islands[i]);
}

}  // namespace stage
}  // namespace pfx
