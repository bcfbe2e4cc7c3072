// Solver bodies as the kernels see them: eight at once, loaded from and stored to their dense records.
#pragma once

#include "pfx/base_level/constraint/solver_body.h"
#include "pfx/base_level/math/lanes.h"

namespace pfx::PFX_LANES {

struct Velocity {
  V8 v, w;
};
struct Mass {
  F8 inv_mass;
  S8 inv_inertia;
};
struct Motion {  // since the start of the step
  V8 dp, u;
  F8 q;
};

// One side of a batch: which bodies, and what of them the kernels use.
struct Side {
  SolverBody* bodies[8];
  Velocity velocity;
  Mass mass;
};

inline F8 laneMask(uint32_t bits) {
  alignas(32) uint32_t m[8];
  for (int i = 0; i < 8; ++i) m[i] = bits >> i & 1 ? 0xffffffffu : 0u;
  return F8::load(reinterpret_cast<const float*>(m));
}

inline Side loadSide(SolverBody* bodies, const int32_t (&index)[8], uint32_t writable) {
  Side s;
  const float* rows[8];
  for (int i = 0; i < 8; ++i) {
    s.bodies[i] = bodies + index[i];
    rows[i] = s.bodies[i]->v;
  }
  F8 t[8];
  loadTransposed(rows, t);
  s.velocity = {{t[0], t[1], t[2]}, {t[4], t[5], t[6]}};
  s.mass.inv_mass = t[3];
  for (int i = 0; i < 8; ++i) rows[i] = s.bodies[i]->inv_inertia;
  loadTransposed(rows, t);
  s.mass.inv_inertia = {t[0], t[1], t[2], t[3], t[4], t[5]};
  if (writable != 0xffu) {
    const F8 m = laneMask(writable);
    s.mass.inv_mass = s.mass.inv_mass & m;
    S8& i = s.mass.inv_inertia;
    i = {i.xx & m, i.xy & m, i.xz & m, i.yy & m, i.yz & m, i.zz & m};
  }
  return s;
}

inline Motion loadMotion(const Side& s) {
  const float* rows[8];
  for (int i = 0; i < 8; ++i) rows[i] = s.bodies[i]->dp;
  F8 t[8];
  loadTransposed(rows, t);
  return {{t[0], t[1], t[2]}, {t[4], t[5], t[6]}, t[7]};
}

inline void storeSide(const Side& s, uint32_t writable) {
  float* rows[8];
  for (int i = 0; i < 8; ++i) rows[i] = writable >> i & 1 ? s.bodies[i]->v : nullptr;
  const Velocity& u = s.velocity;
  const F8 t[8] = {u.v.x, u.v.y, u.v.z, s.mass.inv_mass, u.w.x, u.w.y, u.w.z, F8::zero()};
  storeTransposed(t, rows);
}

// How far the body's rotation has moved the end of `arm` since the start of the step.
inline V8 armShift(const Motion& m, const V8& arm) {
  const V8 t = F8::set(2.0f) * cross(m.u, arm);
  return m.q * t + cross(m.u, t);
}

}  // namespace pfx::PFX_LANES
