// What only few surfaces have, and how the surfaces of a pair go together.
#pragma once

#include <algorithm>
#include <cmath>

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct Surface {
  float torsional_resistance = 0.0f;  // m; the torque about the normal of a pair is at most this times its normal force
  // m/s, body axes: of a conveyor belt, against the body; only what lies in the plane of a contact counts, and only on
  // bodies that impulses do not move.
  Vec3 velocity = Vec3::Zero();

  bool operator==(const Surface&) const = default;
};

// How a pair of bodies gets one coefficient out of two.
enum class Mixing : uint8_t { GeometricMean, Mean, Smaller, Larger, Product };

inline float mix(Mixing mixing, float a, float b) {
  switch (mixing) {
    case Mixing::Mean:
      return 0.5f * (a + b);
    case Mixing::Smaller:
      return std::min(a, b);
    case Mixing::Larger:
      return std::max(a, b);
    case Mixing::Product:
      return a * b;
    case Mixing::GeometricMean:
      break;
  }
  return std::sqrt(a * b);
}

}  // namespace pfx
