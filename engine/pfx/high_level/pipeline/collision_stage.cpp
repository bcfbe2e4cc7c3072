// Collision of a world, and which of its results the solver gets.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {

void detectCollisions(World::Impl& w) {
  const DetectInput input{
      .states = w.store.states, .collidables = w.store.collidables, .reach = w.reach, .pairs = w.pairs, .dt = w.dt};
  w.detector.detect(input, w.contacts, w.tasks);
}

namespace {

// Whether the body touches others with a surface that it can roll on.
bool isRound(const Collidable& c) {
  if (c.shapes().size() != 1) return false;
  const ShapeType type = c.shapes()[0].type();
  return type == ShapeType::Sphere || type == ShapeType::Capsule || type == ShapeType::Cylinder;
}

// Rolling resistance is for what rolls.
void addResistance(const World::Impl& w, ContactConstraint& c) {
  const RigidBody &a = w.store.bodies[c.solver_a], &b = w.store.bodies[c.solver_b];
  if (c.round_a || c.round_b) c.rolling_resistance = std::max(a.rolling_resistance, b.rolling_resistance);
  if (w.store.surfaces.empty()) return;
  c.torsional_resistance =
      std::max(w.store.surface(c.solver_a).torsional_resistance, w.store.surface(c.solver_b).torsional_resistance);
}

}  // namespace

void gatherConstraints(World::Impl& w) {
  for (const Pair& pair : w.pairs) {
    if (!w.solves(pair)) continue;
    const RigidState &a = w.store.states[pair.body_a], &b = w.store.states[pair.body_b];
    const RigidBody &ba = w.store.bodies[pair.body_a], &bb = w.store.bodies[pair.body_b];
    const bool one_way_a = a.motion_type == MotionType::OneWay,
               one_way_b = b.motion_type == MotionType::OneWay;
    for (ContactManifold& m : w.contacts.manifolds(pair.contact_id)) {
      w.constraints.push_back({.manifold = &m,
                               .solver_a = pair.body_a,  // replaced by the set-up
                               .solver_b = pair.body_b,
                               .writable_a = isDynamic(a.motion_type) && !one_way_b,
                               .writable_b = isDynamic(b.motion_type) && !one_way_a,
                               .round_a = isRound(w.store.collidables[pair.body_a]),
                               .round_b = isRound(w.store.collidables[pair.body_b]),
                               .friction = mix(w.def.friction_mixing, ba.friction, bb.friction),
                               .restitution = mix(w.def.restitution_mixing, ba.restitution, bb.restitution)});
      addResistance(w, w.constraints.back());
      w.constraints.back().strain = w.strainOf(w.constraints.back());
      w.any_strained = w.any_strained || w.constraints.back().strain != ContactStrain::None;
    }
  }
  modifyContacts(w);
  for (const ContactConstraint& c : w.constraints) w.needSolverBody(c.solver_a), w.needSolverBody(c.solver_b);
  w.free_bodies.clear();
  for (uint32_t i : w.active)
    if (w.solver_index[i] == kNoSolverBody) w.free_bodies.push_back(i);
}

}  // namespace pfx::stage

namespace pfx {

const Surface* World::Impl::beltOf(uint32_t body) const {
  if (body >= store.surfaces.size() || isDynamic(store.states[body].motion_type)) return nullptr;
  return store.surfaces[body].velocity.isZero() ? nullptr : &store.surfaces[body];
}

void World::Impl::rescaleImpulses(float next_substep) {
  const float scale = substep > 0.0f ? next_substep / substep : 1.0f;
  substep = next_substep;
  if (scale == 1.0f) return;
  for (const auto* list : {&pairs, &sleeping_pairs})
    for (const Pair& pair : *list)
      for (ContactManifold& m : contacts.manifolds(pair.contact_id))
        for (ContactPoint& p : m.points) p.normal_impulse *= scale, p.friction_impulse *= scale;
}

}  // namespace pfx
