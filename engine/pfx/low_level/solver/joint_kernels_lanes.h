// Body of the joint kernels over eight lanes; compiled by joint_kernels_sse2.cpp and joint_kernels_avx2.cpp.
#pragma once

#include "pfx/low_level/solver/body_lanes.h"
#include "pfx/low_level/solver/joint_kernels.h"

namespace pfx::PFX_LANES {

struct JointLanes {
  JointBatch& batch;
  Side a, b;
  Motion ma, mb;
  JointLanes(JointBatch& j, SolverBody* bodies)
      : batch(j),
        a(loadSide(bodies, j.body_a, j.writable_a)),
        b(loadSide(bodies, j.body_b, j.writable_b)),
        ma(loadMotion(a)),
        mb(loadMotion(b)) {}
  void store() const {
    storeSide(a, batch.writable_a);
    storeSide(b, batch.writable_b);
  }
};

inline void applyTo(Side& side, const V8& linear, const V8& angular) {
  side.velocity.v = side.velocity.v + side.mass.inv_mass * linear;
  side.velocity.w = side.velocity.w + side.mass.inv_inertia * angular;
}

// Adds [r] I^-1 [r]^T, the part of the levers in the mobility of a point.
inline void addLever(S8& k, const S8& inv_inertia, const V8& r) {
  const F8 zero = F8::zero();
  const V8 x = cross(inv_inertia * V8{zero, r.z, -r.y}, r);  // (I^-1 (r x e)) x r for each axis e
  const V8 y = cross(inv_inertia * V8{-r.z, zero, r.x}, r);
  const V8 z = cross(inv_inertia * V8{r.y, -r.x, zero}, r);
  k.xx += x.x, k.xy += y.x, k.xz += z.x, k.yy += y.y, k.yz += z.y, k.zz += z.z;
}

// Solves the symmetric positive definite k x = v by cofactors.
inline V8 solve(const S8& k, const V8& v) {
  const F8 a = k.yy * k.zz - k.yz * k.yz, b = k.xz * k.yz - k.xy * k.zz, c = k.xy * k.yz - k.xz * k.yy;
  const F8 determinant = k.xx * a + k.xy * b + k.xz * c;
  const F8 inverse = (F8::set(1.0f) / max(determinant, F8::set(1e-30f))) & (determinant > F8::zero());
  const S8 adjugate = {
      a, b, c, k.xx * k.zz - k.xz * k.xz, k.xy * k.xz - k.xx * k.yz, k.xx * k.yy - k.xy * k.xy};
  return inverse * (adjugate * v);
}

// with_position: pulls the points together; otherwise it only stops them.
inline void solvePoint(JointLanes& j, const JointSolveParams& params, bool with_position) {
  JointBatch& batch = j.batch;
  const V8 start_a = V8::load(batch.arm_a), start_b = V8::load(batch.arm_b);
  const V8 shift_a = armShift(j.ma, start_a), shift_b = armShift(j.mb, start_b);
  const V8 ra = start_a + shift_a, rb = start_b + shift_b;
  const V8 old = V8::load(batch.point_impulse);
  V8 wanted = (j.b.velocity.v + cross(j.b.velocity.w, rb)) - (j.a.velocity.v + cross(j.a.velocity.w, ra));
  F8 scale = F8::load(batch.point_weight), leak = F8::zero();
  if (with_position) {
    const V8 separation = V8::load(batch.separation) + ((j.mb.dp - j.ma.dp) + (shift_b - shift_a));
    wanted = wanted + (F8::set(params.softness.bias_rate) * F8::load(batch.point_bias)) * separation;
    leak = F8::set(params.softness.impulse_scale) * scale;
    scale = F8::set(params.softness.mass_scale) * scale;
    ra.store(batch.lever_a);
    rb.store(batch.lever_b);
  }
  const F8 zero = F8::zero(), mass = j.a.mass.inv_mass + j.b.mass.inv_mass;
  S8 k = {mass, zero, zero, mass, zero, mass};
  addLever(k, j.a.mass.inv_inertia, ra);
  addLever(k, j.b.mass.inv_inertia, rb);
  V8 impulse = old - scale * solve(k, wanted) - leak * old;
  const F8 length2 = dot(impulse, impulse), most = F8::load(batch.max_point_impulse);
  const F8 shorten = select(length2 > most * most, most / max(sqrt(length2), F8::set(1e-30f)), F8::set(1.0f));
  impulse = shorten * impulse;
  impulse.store(batch.point_impulse);
  const V8 change = impulse - old, back = V8{zero, zero, zero} - change;
  applyTo(j.b, change, cross(rb, change));
  applyTo(j.a, back, cross(ra, back));
}

inline void solveAxis(JointLanes& j, JointAxisRows& r, const JointSolveParams& params, bool with_position) {
  const F8 zero = F8::zero(), one = F8::set(1.0f), two = F8::set(2.0f);
  const V8 linear = V8::load(r.linear), ja = V8::load(r.angular_a), jb = V8::load(r.angular_b);
  const F8 speed =
      dot(linear, j.b.velocity.v - j.a.velocity.v) + dot(jb, j.b.velocity.w) + dot(ja, j.a.velocity.w);
  const F8 value =
      F8::load(r.value) + dot(linear, j.mb.dp - j.ma.dp) + two * dot(jb, j.mb.u) + two * dot(ja, j.ma.u);
  const F8 lower = F8::load(r.lower), upper = F8::load(r.upper), middle = F8::set(0.5f) * (lower + upper);
  const F8 at_lower = value < middle;
  const F8 error = select(at_lower, value - lower, value - upper);  // towards the nearer limit
  const F8 is_range = lower < upper;
  const F8 apart = is_range & select(at_lower, error > zero, error < zero);
  const F8 mass = F8::load(r.mass), old = F8::load(r.impulse), most = F8::load(r.max_impulse);

  // Limits and fixed axes
  const F8 open_bias = error * F8::set(params.inv_h);
  F8 bias = open_bias & apart, scale = one, leak = zero;
  if (with_position) {
    bias = select(apart, open_bias, F8::set(params.softness.bias_rate) * F8::load(r.bias) * error);
    scale = select(apart, one, F8::set(params.softness.mass_scale));
    leak = select(apart, zero, F8::set(params.softness.impulse_scale));
  }
  F8 held = old - mass * scale * (speed + bias) - leak * old;
  held = select(is_range, select(at_lower, max(held, zero), min(held, zero)), held);

  // Drives
  const F8 compliance = F8::load(r.compliance);
  const F8 lacking = F8::load(r.target_speed) - speed - compliance * old;
  const F8 driven = old + mass / (one + mass * compliance) * lacking;

  F8 impulse = select(F8::load(r.is_drive) > zero, driven, held);
  impulse = max(min(impulse, most), zero - most) & (mass > zero);
  impulse.store(r.impulse);
  const F8 change = impulse - old;
  applyTo(j.b, change * linear, change * jb);
  applyTo(j.a, (zero - change) * linear, change * ja);
}

inline void solveJoints(JointBatch* batches, uint32_t count, JointAxisRows* rows, SolverBody* bodies,
                        const JointSolveParams& params, bool with_position) {
  for (uint32_t i = 0; i < count; ++i) {
    JointLanes j(batches[i], bodies);
    for (uint32_t k = 0; k < batches[i].num_rows; ++k)
      solveAxis(j, rows[batches[i].first_row + k], params, with_position);
    if (batches[i].has_point) solvePoint(j, params, with_position);
    j.store();
  }
}

inline void pushJoints(JointBatch* batches, uint32_t count, JointAxisRows* rows, SolverBody* bodies,
                       const JointSolveParams& params) {
  solveJoints(batches, count, rows, bodies, params, true);
}

inline void relaxJoints(JointBatch* batches, uint32_t count, JointAxisRows* rows, SolverBody* bodies,
                        const JointSolveParams& params) {
  solveJoints(batches, count, rows, bodies, params, false);
}

inline void warmStartJoints(JointBatch* batches, uint32_t count, JointAxisRows* rows, SolverBody* bodies,
                            const JointSolveParams&) {
  for (uint32_t i = 0; i < count; ++i) {
    JointLanes j(batches[i], bodies);
    for (uint32_t k = 0; k < batches[i].num_rows; ++k) {
      JointAxisRows& r = rows[batches[i].first_row + k];
      const V8 linear = V8::load(r.linear);
      const F8 impulse = F8::load(r.impulse);
      applyTo(j.b, impulse * linear, impulse * V8::load(r.angular_b));
      applyTo(j.a, (F8::zero() - impulse) * linear, impulse * V8::load(r.angular_a));
    }
    if (batches[i].has_point) {
      const V8 p = V8::load(batches[i].point_impulse), back = V8{F8::zero(), F8::zero(), F8::zero()} - p;
      applyTo(j.b, p, cross(V8::load(batches[i].arm_b), p));
      applyTo(j.a, back, cross(V8::load(batches[i].arm_a), back));
    }
    j.store();
  }
}

// Bodies start a sub-step with the change that the last one's impulses made (see substep.h). The force of a point goes on
// as it was; its torque has to follow the levers, or the swing of a whip feeds itself.
inline void followLevers(JointBatch* batches, uint32_t count, JointAxisRows*, SolverBody* bodies,
                         const JointSolveParams&) {
  for (uint32_t i = 0; i < count; ++i) {
    JointBatch& batch = batches[i];
    if (!batch.has_point) continue;
    JointLanes j(batch, bodies);
    const V8 start_a = V8::load(batch.arm_a), start_b = V8::load(batch.arm_b);
    const V8 turned_a = (start_a + armShift(j.ma, start_a)) - V8::load(batch.lever_a);
    const V8 turned_b = (start_b + armShift(j.mb, start_b)) - V8::load(batch.lever_b);
    const V8 p = V8::load(batch.point_impulse);
    j.b.velocity.w = j.b.velocity.w + j.b.mass.inv_inertia * cross(turned_b, p);
    j.a.velocity.w = j.a.velocity.w - j.a.mass.inv_inertia * cross(turned_a, p);
    j.store();
  }
}

}  // namespace pfx::PFX_LANES
