// Islands that the island solver takes: which, and their step.
//
// Sequential impulses carry a load through a stack one contact a sweep, and lose it where it is many times
// what the lighter body weighs: low in a tall stack, under something heavy. They let slip what only holds
// while nothing gives way: stones of an arch, cards that lean. Each contact tells by its impulse, masses and
// normal whether it is of that kind, so that a world in which nothing is strained pays for a comparison a
// manifold.
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
constexpr size_t kMostSmallBodies = 256;

// Bodies of all islands of a step. A crowd of stacks is left to the sequential impulses as a whole: 196 pyramids of 55
// boxes took seconds a step.
constexpr size_t kMostBodiesInAll = 300;

// A contact is strained when it carries this many times the weight of its lighter body, or when the body on
// top is this many times as heavy. It leans when its normal is farther from the vertical than this (cosine).
constexpr float kLoad = 5.0f;
constexpr float kMassRatio = 20.0f;
constexpr float kLeaning = 0.95f;

// Soft rows give way by a few times what a body falls from rest in a sub-step (g h^2), whatever its size; until a pile
// of twenty layers carries its weight it sinks by fifty times as much. A contact whose lever is shorter than this many
// of them is between small bodies.
constexpr float kSmallFalls = 300.0f;

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

NewtonParams newtonParams(const World::Impl& w) {
  return {.h = static_cast<double>(w.dt) / w.def.substeps,
          .substeps = w.def.substeps,
          .restitution_threshold = stage::restitutionThreshold(w)};
}

bool isSmall(const World::Impl& w, const ContactConstraint& c) {
  if (c.round_a || c.round_b || c.manifold->num_points == 0) return false;
  const ContactPoint& p = c.manifold->points[0];
  const float lever = std::min(p.local_a.squaredNorm(), p.local_b.squaredNorm());
  const float most = kSmallFalls * fallSpeed(w) * w.dt / static_cast<float>(w.def.substeps);
  return lever < most * most;
}

// Whether every body that a constraint could move is moved by it, and none has a surface that moves by itself.
bool isSymmetric(const World::Impl& w, const ContactConstraint& c) {
  return w.motionOf(c.solver_a) == nullptr && w.motionOf(c.solver_b) == nullptr &&
         c.writable_a == isDynamic(w.store.states[c.solver_a].motion_type) &&
         c.writable_b == isDynamic(w.store.states[c.solver_b].motion_type);
}

bool isAskedFor(const World::Impl& w, uint32_t island) {
  if (w.def.contact_solver == ContactSolver::Newton) return true;
  const size_t size = w.contact_islands.bodies(island).size();
  const auto links = w.contact_islands.links(island);
  size_t resting = 0, small = 0;
  bool loaded = false, leaning = false;
  for (uint32_t i : links) {
    const ContactConstraint& c = w.constraints[i];
    resting += isResting(w, c);
    small += isSmall(w, c);
    loaded = loaded || c.strain == ContactStrain::Loaded;
    leaning = leaning || c.strain == ContactStrain::Leaning;
  }
  const bool mostly_small = 2 * small > links.size();
  return (mostly_small || (loaded && size <= kMostBodies) || (leaning && size <= kMostLeaningBodies)) &&
         static_cast<double>(resting) >= kRestingShare * static_cast<double>(links.size());
}

bool isEligible(const World::Impl& w, uint32_t island) {
  const auto links = w.contact_islands.links(island);
  if (links.empty() || links.back() >= w.constraints.size()) return false;  // the last ones are joints
  if (w.contact_islands.bodies(island).size() > kMostSmallBodies) return false;
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
  if (!c.writable_a || !c.writable_b) return ContactStrain::None;
  const float mass_a = store.bodies[c.solver_a].mass, mass_b = store.bodies[c.solver_b].mass;
  const float height = -c.manifold->normal.dot(def.gravity), gravity = def.gravity.norm();
  if (gravity == 0.0f) return ContactStrain::None;
  float impulse = 0.0f;
  for (int i = 0; i < c.manifold->num_points; ++i) impulse += c.manifold->points[i].normal_impulse;
  if (impulse > kLoad * std::min(mass_a, mass_b) * fallSpeed(*this)) return ContactStrain::Loaded;
  const float top = height > 0.0f ? mass_b : mass_a, bottom = height > 0.0f ? mass_a : mass_b;
  const bool leans = std::abs(height) < kLeaning * gravity;
  if (top > kMassRatio * bottom && !leans) return ContactStrain::Loaded;
  if (leans && !c.round_a && !c.round_b) return ContactStrain::Leaning;
  return isSmall(*this, c) ? ContactStrain::Small : ContactStrain::None;
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
