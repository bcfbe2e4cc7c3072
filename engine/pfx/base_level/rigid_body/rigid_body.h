// What a body is made of: mass, inertia, surface. Rarely changes.
#pragma once

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct RigidBody {
  float mass = 1.0f;                // kg
  Mat3 inertia = Mat3::Identity();  // kg m^2, body axes, about the centre of mass; symmetric positive definite
  float restitution = 0.2f;         // 0 .. 1; a pair uses the mean, unless WorldDef says otherwise
  float friction = 0.6f;            // >= 0; a pair uses the geometric mean, likewise
  float linear_damping = 0.0f;      // 1/s; velocity decays as exp(-damping t), whatever the step
  float angular_damping = 0.0f;     // 1/s
  // m; balls, capsules and cylinders that roll meet a torque of at most this times the normal force; a pair uses the larger
  float rolling_resistance = 0.0f;
  float gravity_scale = 1.0f;
};

}  // namespace pfx
