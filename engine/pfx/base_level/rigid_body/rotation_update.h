// Advances the orientation of a torque-free body by one step, in momentum form.
//
// The angular momentum L is constant in the world during the drift, so orientation is integrated as
//   q' = f(q) q,  f(q) = R(q) I^-1 R(q)^T L,
// which conserves L to rounding, unlike updates of the angular velocity with a gyroscopic term. The method is chosen
// by how far the body turns in the step:
//   spherical inertia, or |w| h < 1e-3   one exponential (exact for a sphere)
//   up to |w| h = 0.05                   midpoint on the group, 2nd order
//   beyond                               Runge-Kutta-Munthe-Kaas, 4th order
// Source: A. Iserles, H. Munthe-Kaas, S. Norsett, A. Zanna, Lie-group methods, Acta Numerica 9, 2000, section 4.
#pragma once

#include "pfx/base_level/math/vector.h"

namespace pfx {

// Quaternion of the rotation by |u| radians about u.
Quat expMap(const Vec3& u);

struct Inertia {
  Mat3 body;          // kg m^2, body axes
  Mat3 inverse_body;  // 1 / (kg m^2)
  bool spherical;     // the same about every axis: the angular velocity is constant in free rotation
};

// Spherical when the moments differ by less than 1e-6 relative. `inertia` must be positive definite.
Inertia makeInertia(const Mat3& inertia);

struct Rotation {
  Quat orientation;
  Vec3 angular_velocity;  // rad/s, world axes
};

// The rotation after `h` seconds without torque.
Rotation advanceRotation(const Rotation& start, const Inertia& inertia, float h);

// World inverse inertia R I^-1 R^T.
Mat3 worldInverseInertia(const Quat& orientation, const Inertia& inertia);

}  // namespace pfx
