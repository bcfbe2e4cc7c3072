// Rotations in double precision, with the bits of pfx/base_level/math/trig.h.
#pragma once

#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/math/vector_double.h"

namespace samples::accuracy {

// By |u| radians about u.
inline pfx::Quatd turn(const pfx::Vec3d& u) {
  const double angle = u.norm();
  if (angle < 1e-300) return pfx::Quatd::Identity();
  const pfx::SinCosDouble half = pfx::sincos(0.5 * angle);
  const pfx::Vec3d v = half.sin / angle * u;
  return {half.cos, v.x(), v.y(), v.z()};
}

// About Z.
inline pfx::Quatd turnZ(double angle) { return turn(pfx::Vec3d(0, 0, angle)); }

// q' = w q / 2, coefficients in the order x, y, z, w.
inline Eigen::Vector4d orientationRate(const pfx::Vec3d& w, const Eigen::Vector4d& q) {
  Eigen::Vector4d rate;
  rate << 0.5 * (q[3] * w + w.cross(q.head<3>())), -0.5 * w.dot(q.head<3>());
  return rate;
}

// rad, 0 .. pi
inline double angleBetween(const pfx::Quatd& a, const pfx::Quatd& b) {
  const pfx::Quatd d = a.conjugate() * b;
  return 2.0 * pfx::atan2(d.vec().norm(), std::abs(d.w()));
}
inline double angleBetween(const pfx::Vec3d& a, const pfx::Vec3d& b) {
  return pfx::atan2(a.cross(b).norm(), a.dot(b));
}

// rad, -pi .. pi, of a rotation about Z
inline double angleAboutZ(const pfx::Quatd& q) {
  const double half = pfx::atan2(q.z(), q.w());
  return std::remainder(2.0 * half, 2.0 * pfx::kPiDouble);
}

inline double wrapped(double angle) { return std::remainder(angle, 2.0 * pfx::kPiDouble); }

}  // namespace samples::accuracy
