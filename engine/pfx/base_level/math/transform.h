// Rigid transform: rotation followed by translation.
#pragma once

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct Transform {
  Vec3 position = Vec3::Zero();         // m
  Quat orientation = Quat::Identity();  // unit

  Vec3 apply(const Vec3& p) const { return position + orientation * p; }
  Vec3 applyInverse(const Vec3& p) const { return orientation.conjugate() * (p - position); }
};

// a * b: first b, then a.
inline Transform operator*(const Transform& a, const Transform& b) {
  return {a.apply(b.position), a.orientation * b.orientation};
}

// inverse(a) * b: the pose of b seen from a.
inline Transform relative(const Transform& a, const Transform& b) {
  return {a.applyInverse(b.position), a.orientation.conjugate() * b.orientation};
}

}  // namespace pfx
