// Integration of solver bodies over one sub-step, in momentum form.
//
// The impulses of a sub-step are remembered per body rather than per contact: with levers fixed within a
// step, starting the next sub-step from the same impulses is the same as adding the velocity change they
// made. So contacts are warm started from their rows in the first sub-step only.
#pragma once

#include <span>

#include "pfx/base_level/constraint/solver_body.h"
#include "pfx/base_level/rigid_body/rotation_update.h"

namespace pfx {

// What integration needs of a solver body besides SolverBody; same index.
struct BodyMotion {
  Quat start_orientation;  // at the start of the step
  const Inertia* inertia;  // null for bodies that impulses do not move
  Vec3 acceleration;       // m/s^2, gravity and force / mass
  Vec3 torque;             // N m, world axes
  float linear_decay;      // factor on the velocity a sub-step, exp(-damping h)
  float angular_decay;
  // Of the current sub-step:
  Vec3 free_velocity;     // m/s, before the impulses
  Vec3 free_momentum;     // N m s, world axes, before the impulses
  Vec3 impulse_velocity;  // m/s, change that the impulses of the last sub-step made
  Vec3 impulse_momentum;  // N m s, world axes, likewise
};

// Velocities at the start of a sub-step of h seconds: external forces, damping, and the last sub-step's
// impulses.
void integrateVelocities(std::span<SolverBody> bodies, std::span<BodyMotion> motions, float h);

// Positions and orientations after the sub-step; the inverse inertia follows.
void integratePositions(std::span<SolverBody> bodies, std::span<const BodyMotion> motions, float h);

// Remembers what the impulses of this sub-step did.
void rememberImpulses(std::span<const SolverBody> bodies, std::span<BodyMotion> motions);

// Packs a symmetric matrix as SolverBody::inv_inertia.
void setInverseInertia(SolverBody& body, const Mat3& inverse);

}  // namespace pfx
