// Rigid bodies as particles see them during the sub-steps of a step.
//
// The world has moved its bodies already. During the step they go the way from where they were to where they are, and
// what particles do to them comes on top: each correction moves the body at once, so that both sides of a contact feel
// their true masses, and changes its velocity as in the position-based dynamics of rigid bodies.
// Source: M. Mueller et al., Detailed Rigid Body Simulation with Extended Position Based Dynamics, SCA 2020.
#pragma once

#include <span>

#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/base_level/shape/collidable.h"

namespace pfx {

// The bodies of a world after a step of dt seconds. Arrays by body index.
struct ParticleSurroundings {
  std::span<RigidState> states;
  std::span<const RigidBody> bodies;
  std::span<const Inertia> inertias;
  std::span<const Collidable> collidables;
  std::span<const Transform> start_poses;  // before the step
};

class ParticleBody {
 public:
  ParticleBody(const ParticleSurroundings& around, uint32_t body);

  // Goes to the end of sub-step `k` of `count`, each of h seconds.
  void advance(int k, int count, float h);

  // Moves the body by an impulse (kg m, i.e. impulse times h) at a world point.
  void push(const Vec3& impulse, const Vec3& point, float h);

  // Writes what was pushed to the state of the body. A body that sleeps stays where it is.
  void finish(RigidState& state) const;

  // m/s, the velocity that particles would have given a body that sleeps; 0 for others.
  float sleptThrough() const { return is_asleep_ ? velocity_.norm() : 0.0f; }
  // Whether impulses count: it moves when pushed, or may be woken.
  bool feels() const { return inverse_mass > 0.0f || is_asleep_; }

  // 1/kg, against an impulse along a unit direction at a world point.
  float inverseMass(const Vec3& point, const Vec3& direction) const {
    if (inverse_mass == 0.0f) return 0.0f;
    const Vec3 turn = (point - now.position).cross(direction);
    return inverse_mass + turn.dot(inverse_inertia * turn);
  }
  // 1/kg, the least that a point of the body weighs against any direction.
  float inverseMass(const Vec3& point) const;

  uint32_t body;
  bool yields_only = false;  // a one-way body: is pushed and does not push
  float inverse_mass = 0.0f;
  float friction = 0.0f;
  Transform before, now;  // at both ends of the sub-step

 private:
  Transform start_, end_;
  Mat3 inverse_inertia = Mat3::Zero();
  Vec3 shift_ = Vec3::Zero(), turn_ = Vec3::Zero();        // m, rad: by particles
  Vec3 velocity_ = Vec3::Zero(), spin_ = Vec3::Zero();     // m/s, rad/s: by particles
  bool is_pushed_ = false, is_asleep_ = false;
  float mass_ = 1.0f;  // kg
};

}  // namespace pfx
