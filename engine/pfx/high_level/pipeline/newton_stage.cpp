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
constexpr size_t kMostSmallBodies = 256;
// Where contacts touch joints with heavy loads. Chains fill no factor, and have nobody else to turn to.
constexpr size_t kMostJointedBodies = 512;

// Bodies of all islands of a step. A crowd of stacks is left to the sequential impulses as a whole: 196 pyramids of 55
// boxes took seconds a step.
constexpr size_t kMostBodiesInAll = 512;

// A contact is strained when it carries this many times the weight of its lighter body, or when the body on
// top is this many times as heavy. It leans when its normal is farther from the vertical than this (cosine).
constexpr float kLoad = 5.0f;
constexpr float kMassRatio = 20.0f;
constexpr float kLeaning = 0.95f;

// Soft rows give way by a few times what a body falls from rest in a sub-step (g h^2), whatever its size; until a pile
// of twenty layers carries its weight it sinks by fifty times as much. A contact whose lever is shorter than this many
// of them is between small bodies.
constexpr float kSmallFalls = 300.0f;

// Joints soften and share out loads that they can. Beside them a contact counts as strained from this many times the
// weight of its lighter body on: a machine presses on what it holds.
constexpr float kPressed = 64.0f;

// Contacts between bodies that move against each other by less than this (in sub-steps of free fall) are at
// rest. An island needs this share of them: what tumbles is nothing to hold up.
constexpr float kRestingFall = 8.0f;
constexpr double kRestingShare = 0.75;

float fallSpeed(const World::Impl& w) {
  return w.def.gravity.norm() * w.dt / static_cast<float>(w.def.substeps);
}

float impulseOf(const ContactManifold& m) {
  float sum = 0.0f;
  for (int i = 0; i < m.num_points; ++i) sum += m.points[i].normal_impulse;
  return sum;
}

bool isResting(const World::Impl& w, const ContactConstraint& c) {
  const float most = kRestingFall * fallSpeed(w);
  return (w.store.states[c.solver_b].linear_velocity - w.store.states[c.solver_a].linear_velocity)
             .squaredNorm() < most * most;
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

bool isSmall(const World::Impl& w, const ContactConstraint& c) {
  if (c.round_a || c.round_b || c.manifold->num_points == 0) return false;
  const ContactPoint& p = c.manifold->points[0];
  const float lever = std::min(p.local_a.squaredNorm(), p.local_b.squaredNorm());
  const float most = kSmallFalls * fallSpeed(w) * w.dt / static_cast<float>(w.def.substeps);
  return lever < most * most;
}

// Whether every body that a constraint could move is moved by it, and none has a surface that moves by itself
// or resists turning.
bool isSymmetric(const World::Impl& w, const ContactConstraint& c) {
  const auto is_plain = [&](uint32_t body) { return w.motionOf(body) == nullptr && w.beltOf(body) == nullptr; };
  return is_plain(c.solver_a) && is_plain(c.solver_b) && !resistsTurning(c) &&
         c.writable_a == isDynamic(w.store.states[c.solver_a].motion_type) &&
         c.writable_b == isDynamic(w.store.states[c.solver_b].motion_type);
}

bool isSymmetric(const World::Impl& w, const JointConstraint& c) {
  return c.writable_a == isDynamic(w.store.states[c.body_a].motion_type) &&
         c.writable_b == isDynamic(w.store.states[c.body_b].motion_type);
}

// Of an island: first contacts, then joints.
std::span<const uint32_t> contactsOf(const World::Impl& w, uint32_t island) {
  const auto links = w.contact_islands.links(island);
  const auto end = std::lower_bound(links.begin(), links.end(), static_cast<uint32_t>(w.constraints.size()));
  return links.first(static_cast<size_t>(end - links.begin()));
}

bool isUnequal(const World::Impl& w, const ContactConstraint& c) {
  if (!c.writable_a || !c.writable_b) return false;
  const auto [lighter, heavier] = std::minmax(w.store.bodies[c.solver_a].mass, w.store.bodies[c.solver_b].mass);
  return heavier > kMassRatio * lighter;
}

bool isPressed(const World::Impl& w, const ContactConstraint& c) {
  if (c.strain != ContactStrain::Loaded) return false;
  const float lighter = std::min(w.store.bodies[c.solver_a].mass, w.store.bodies[c.solver_b].mass);
  return impulseOf(*c.manifold) > kPressed * lighter * fallSpeed(w);
}

bool isMostlyAtRest(const World::Impl& w, std::span<const uint32_t> contacts) {
  const auto resting = std::ranges::count_if(contacts, [&](uint32_t i) { return isResting(w, w.constraints[i]); });
  return static_cast<double>(resting) >= kRestingShare * static_cast<double>(contacts.size());
}

std::span<const uint32_t> jointsOf(const World::Impl& w, uint32_t island) {
  return w.contact_islands.links(island).subspan(contactsOf(w, island).size());
}

// Contacts that touch joints which are too heavily loaded for soft rows.
bool touchesStiffJoints(World::Impl& w, std::span<const uint32_t> joints) {
  return std::ranges::any_of(joints, [&](uint32_t i) {
    return !w.joint_components.componentOf(i - static_cast<uint32_t>(w.constraints.size())).is_soft;
  });
}

// A machine presses on what it holds, and may crush it while it closes.
bool isAskedForBeside(World::Impl& w, uint32_t island, std::span<const uint32_t> joints) {
  const size_t bodies = w.contact_islands.bodies(island).size();
  const auto contacts = contactsOf(w, island);
  const auto any = [&](auto&& condition) {
    return std::ranges::any_of(contacts, [&](uint32_t i) { return condition(w, w.constraints[i]); });
  };
  if (bodies <= kMostJointedBodies && touchesStiffJoints(w, joints)) return true;
  return bodies <= kMostBodies && (any(isUnequal) || (any(isPressed) && isMostlyAtRest(w, contacts)));
}

bool isFresh(const ContactConstraint& c) { return impulseOf(*c.manifold) == 0.0f; }

// Not for the moment: what has just touched is taken as strained for one step, in a structure that was set up as a whole.
bool isStrained(const World::Impl& w, const ContactConstraint& c, size_t bodies) {
  if (c.strain == ContactStrain::Leaning) return bodies <= kMostLeaningBodies;
  return bodies <= kMostBodies && c.strain == ContactStrain::Loaded && (!isFresh(c) || isTopHeavy(w, c));
}

bool isAskedForAlone(const World::Impl& w, uint32_t island) {
  const size_t bodies = w.contact_islands.bodies(island).size();
  if (bodies > kMostSmallBodies) return false;
  bool strained = false, set_up = bodies <= kMostBodies, some_load = false;
  size_t small = 0;
  const auto contacts = contactsOf(w, island);
  for (uint32_t i : contacts) {
    const ContactConstraint& c = w.constraints[i];
    strained = strained || isStrained(w, c, bodies);
    set_up = set_up && isFresh(c);
    some_load = some_load || c.strain == ContactStrain::Loaded;
    small += isSmall(w, c);
  }
  return (strained || (set_up && some_load) || 2 * small > contacts.size()) && isMostlyAtRest(w, contacts);
}

bool isAskedFor(World::Impl& w, uint32_t island) {
  if (w.def.contact_solver == ContactSolver::Newton) return w.contact_islands.bodies(island).size() <= kMostSmallBodies;
  const auto joints = jointsOf(w, island);
  if (joints.empty()) return isAskedForAlone(w, island);
  return !stage::isJointCrowd(w) && isAskedForBeside(w, island, joints);
}

bool isEligible(World::Impl& w, uint32_t island) {
  const auto contacts = contactsOf(w, island), joints = jointsOf(w, island);
  const auto n = static_cast<uint32_t>(w.constraints.size());
  return !contacts.empty() &&
         std::ranges::all_of(contacts, [&](uint32_t i) { return isSymmetric(w, w.constraints[i]); }) &&
         std::ranges::all_of(joints, [&](uint32_t i) { return isSymmetric(w, w.joint_constraints[i - n]); }) &&
         isAskedFor(w, island);
}

bool areTooMany(World::Impl& w) {
  if (w.def.contact_solver == ContactSolver::Newton) return false;
  size_t bodies = 0;
  for (uint32_t k = 0; k < w.contact_islands.size() && bodies <= kMostBodiesInAll; ++k)
    if (isEligible(w, k)) bodies += w.contact_islands.bodies(k).size();
  return bodies > kMostBodiesInAll;
}

void takeJoint(World::Impl& w, NewtonTask& task, uint32_t joint) {
  const JointConstraint& j = w.joint_constraints[joint];
  task.joints.push_back(j);
  task.bodies.insert(task.bodies.end(), {j.body_a, j.body_b});
  JointComponent& component = w.joint_components.componentOf(joint);
  if (std::ranges::find(task.components, &component) != task.components.end()) return;
  task.components.push_back(&component);
  w.joint_step.remove(component);
}

void take(World::Impl& w, uint32_t island) {
  if (w.newton_islands.size() == w.num_newton_islands) w.newton_islands.emplace_back();
  NewtonTask& task = w.newton_islands[w.num_newton_islands++];
  task.bodies.clear(), task.motions.clear(), task.constraints.clear(), task.joints.clear(), task.components.clear();
  for (uint32_t i : contactsOf(w, island)) {
    ContactConstraint& c = w.constraints[i];
    task.constraints.push_back(c);
    task.bodies.insert(task.bodies.end(), {c.solver_a, c.solver_b});
    c.manifold = nullptr;  // taken
  }
  for (uint32_t i : jointsOf(w, island))
    takeJoint(w, task, i - static_cast<uint32_t>(w.constraints.size()));
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

// To the sequential impulses, joints as well: a direct solve beside sweeps would throw what defeated Newton's method.
void giveBack(World::Impl& w, const NewtonTask& task) {
  for (JointComponent* c : task.components) {
    c->is_soft = true;
    w.joint_step.add(*c);
    for (uint32_t i : c->bodies) w.needSolverBody(i);
  }
  w.constraints.insert(w.constraints.end(), task.constraints.begin(), task.constraints.end());
  for (const ContactConstraint& c : task.constraints) w.needSolverBody(c.solver_a), w.needSolverBody(c.solver_b);
}

}  // namespace

ContactStrain World::Impl::strainOf(const ContactConstraint& c) const {
  if (!c.writable_a || !c.writable_b || def.gravity.isZero()) return ContactStrain::None;
  const float lighter = std::min(store.bodies[c.solver_a].mass, store.bodies[c.solver_b].mass);
  const float impulse = impulseOf(*c.manifold);
  if (impulse > kLoad * lighter * fallSpeed(*this) || isTopHeavy(*this, c)) return ContactStrain::Loaded;
  if (leans(*this, c)) return c.round_a || c.round_b ? ContactStrain::None : ContactStrain::Leaning;
  if (impulse == 0.0f && isResting(*this, c)) return ContactStrain::Loaded;
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
      t.solver.begin(w.store.states, w.store.bodies, {t.bodies, t.motions, t.constraints, t.joints}, params);
      t.is_solved = t.solver.advance(w.store.states);
    }
  });
  for (uint32_t i = 0; i < w.num_newton_islands; ++i)
    if (!w.newton_islands[i].is_solved) giveBack(w, w.newton_islands[i]);
}

}  // namespace stage
}  // namespace pfx
