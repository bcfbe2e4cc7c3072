// Vector types of the engine: Eigen's, under the names that physics uses.
//
// All types are unaligned on purpose (no 16-byte requirement), so that records pack densely, their layout
// does not depend on the instruction set a client compiles for, and Eigen uses the same scalar code path
// everywhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pfx {

using Vec2 = Eigen::Vector2f;
using Vec3 = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3f;
using Quat =
    Eigen::Quaternion<float, Eigen::DontAlign>;  // w + xi + yj + zk; rotates body frame to world frame

// Cross-product matrix: skew(a) * b == a x b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

// Two unit vectors that complete the unit vector n to a right-handed orthonormal frame (t1, t2, n).
// Source: T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
struct TangentPair {
  Vec3 t1, t2;
};
inline TangentPair tangents(const Vec3& n) {
  const float sign = n.z() < 0.0f ? -1.0f : 1.0f;
  const float a = -1.0f / (sign + n.z());
  const float b = n.x() * n.y() * a;
  return {Vec3(1.0f + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

}  // namespace pfx
