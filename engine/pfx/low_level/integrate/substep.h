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
  bool keeps_pace;  // whether the drift follows the mean velocity of a sub-step, see setLag()
  // Of the current sub-step:
  Vec3 free_velocity;     // m/s, before the impulses
  Vec3 free_momentum;     // N m s, world axes, before the impulses
  Vec3 impulse_velocity;  // m/s, change that the impulses of the last sub-step made
  Vec3 impulse_momentum;  // N m s, world axes, likewise
  Vec3 start_velocity;    // m/s, before forces and impulses
  Vec3 lag;               // m, what the drift goes too far
};

// Velocities at the start of a sub-step of h seconds: external forces, damping, and the last sub-step's
// impulses.
void integrateVelocities(std::span<SolverBody> bodies, std::span<BodyMotion> motions, float h);

// A drift at the velocity of the end of a sub-step goes too far by half of what the sub-step changed in it: a box that
// friction stops would come to rest short by mu g h / v of its way. setLag() notes that half, from the velocity that
// forces and the impulses of the last sub-step give, and the drift leaves it out: the trapezoidal rule, which is exact
// under a constant force. It does so across gravity only, and for what moves: along gravity, what settles on others needs
// the damping of the full drift (a pyramid of 20 rows sank twice as deep without). What changes a velocity by more than a
// few sub-steps of free fall is an impact and no force, and is left alone. What got no impulse in the sub-step is in free
// flight, and follows it exactly.
void setLag(std::span<const SolverBody> bodies, std::span<BodyMotion> motions, float h);

// Positions and orientations after the sub-step; the inverse inertia follows.
void integratePositions(std::span<SolverBody> bodies, std::span<const BodyMotion> motions, float h);

// Remembers what the impulses of this sub-step did.
void rememberImpulses(std::span<const SolverBody> bodies, std::span<BodyMotion> motions);

// Packs a symmetric matrix as SolverBody::inv_inertia.
void setInverseInertia(SolverBody& body, const Mat3& inverse);

}  // namespace pfx
