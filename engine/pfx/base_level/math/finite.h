// Whether input is made of finite numbers.
#pragma once

#include "pfx/base_level/math/transform.h"

namespace pfx {

// Zero times anything but a finite number is not a number.
inline bool isFinite(const Vec3& v) { return v.sum() * 0.0f == 0.0f; }
inline bool isFinite(const Transform& t) {
  return (t.position.sum() + t.orientation.coeffs().sum()) * 0.0f == 0.0f;
}

}  // namespace pfx
