// Shared by the tests of sequential impulses: a body by its mass.
#pragma once

#include "pfx/low_level/solver/sequential_impulse.h"

namespace pfx {

// mass: kg; inertia: kg m^2, the same about every axis.
inline ImpulseBody massive(float mass, float inertia) {
  ImpulseBody body = {};
  body.inv_mass = 1.0f / mass;
  for (int k = 0; k < 3; ++k) body.inv_inertia[4 * k] = 1.0f / inertia;
  return body;
}

}  // namespace pfx
