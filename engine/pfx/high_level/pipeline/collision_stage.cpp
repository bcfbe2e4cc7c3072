// Collision of a world, and which of its results the solver gets.
#include <cmath>

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
                               .friction = std::sqrt(ba.friction * bb.friction),
                               .restitution = 0.5f * (ba.restitution + bb.restitution)});
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
