#include "compat/physics_effects/vectormath.h"

#include <algorithm>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/math/vector.h"

namespace sce::Vectormath::Scalar::Aos {

Quat Quat::rotation(float radians, const Vector3& unit_axis) {
  return Quat(unit_axis * pfx::sin(0.5f * radians), pfx::cos(0.5f * radians));
}

// The half-way vector makes the half angle; opposite vectors turn about any axis across them.
Quat Quat::rotation(const Vector3& unit_from, const Vector3& unit_to) {
  const float c = dot(unit_from, unit_to);
  if (c > -0.999999f) {
    const float s = std::sqrt(2.0f * (1.0f + c));
    return Quat(cross(unit_from, unit_to) / s, 0.5f * s);
  }
  const Vector3 other = std::abs(unit_from[0]) < 0.7f ? Vector3::xAxis() : Vector3::yAxis();
  return Quat(normalize(cross(unit_from, other)), 0.0f);
}

Quat::Quat(const Matrix3& m) {
  pfx::Mat3 e;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) e(r, c) = m[c][r];
  const pfx::Quat q(e);
  *this = Quat(q.x(), q.y(), q.z(), q.w());
}

Quat slerp(float t, const Quat& unit_a, const Quat& unit_b) {
  float c = dot(unit_a, unit_b);
  const Quat start = c < 0.0f ? -unit_a : unit_a;
  c = std::min(std::abs(c), 1.0f);
  if (c > 0.9995f) return normalize(lerp(t, start, unit_b));
  const float angle = pfx::acos(c), s = 1.0f / pfx::sin(angle);
  return start * (pfx::sin((1.0f - t) * angle) * s) + unit_b * (pfx::sin(t * angle) * s);
}

}  // namespace sce::Vectormath::Scalar::Aos
