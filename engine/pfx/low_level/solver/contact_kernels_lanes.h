// Body of the contact kernels over eight lanes; compiled by contact_kernels_sse2.cpp and
// contact_kernels_avx2.cpp.
#pragma once

#include "pfx/low_level/solver/body_lanes.h"
#include "pfx/low_level/solver/contact_kernels.h"

namespace pfx::PFX_LANES {

// Writes back only the velocity of writable lanes; a read-only lane of a one-way pair keeps its true mass,
// because its row is not stored at all.
struct Batch {
  ContactRows& rows;
  Side a, b;
  Batch(ContactRows& r, SolverBody* bodies)
      : rows(r), a(loadSide(bodies, r.body_a, r.writable_a)), b(loadSide(bodies, r.body_b, r.writable_b)) {}
  void store() const {
    storeSide(a, rows.writable_a);
    storeSide(b, rows.writable_b);
  }
};

// Adds the impulse p (on B at arm_b, minus p on A at arm_a).
inline void apply(Batch& c, const V8& p, const V8& arm_a, const V8& arm_b) {
  c.a.velocity.v = c.a.velocity.v - c.a.mass.inv_mass * p;
  c.a.velocity.w = c.a.velocity.w - c.a.mass.inv_inertia * cross(arm_a, p);
  c.b.velocity.v = c.b.velocity.v + c.b.mass.inv_mass * p;
  c.b.velocity.w = c.b.velocity.w + c.b.mass.inv_inertia * cross(arm_b, p);
}

inline V8 relativeVelocity(const Batch& c, const V8& arm_a, const V8& arm_b) {
  return (c.b.velocity.v + cross(c.b.velocity.w, arm_b)) - (c.a.velocity.v + cross(c.a.velocity.w, arm_a));
}

// Where the friction of a point acts: pulled in towards the centre, so that a patch resists spin like a
// spread pressure and not like its corners.
inline V8 frictionArm(const V8& center, const V8& arm, F8 spread) { return center + spread * (arm - center); }

// How a body has turned since the start of the step, as its contact points see it. On a round body they stay where they
// are while the surface passes below them. So only the first-order part counts there, which has no component along the
// normal when the body rolls, and of that only the swing: what turns about the normal, like a coin that spins on its
// face, moves no surface up or down, and left in would turn the tilt. With q = swing * twist about n, the swing's vector
// is w u - (u n) (u x n), but for a factor near 1. turns: 1 or 0, see ContactRows.
struct ContactTurn {
  V8 vector, u;
  F8 turns, w_turns;  // w_turns: turns * (w - 1)
};
inline ContactTurn contactTurn(const Motion& m, const V8& n, F8 turns) {
  const V8 swing = m.q * m.u - dot(m.u, n) * cross(m.u, n);
  const F8 rigid = turns > F8::zero();
  const V8 vector = {select(rigid, m.u.x, swing.x), select(rigid, m.u.y, swing.y), select(rigid, m.u.z, swing.z)};
  return {vector, m.u, turns, turns * (m.q - F8::set(1.0f))};
}

// How far that has moved the end of `arm`.
inline V8 contactShift(const ContactTurn& turn, const V8& arm) {
  const V8 t = F8::set(2.0f) * cross(turn.vector, arm);
  return t + turn.w_turns * t + turn.turns * cross(turn.u, t);
}

// Softness of a row, from its two kinds.
inline void storeSoftness(ContactRows& r, F8 both_move, const ContactSolveParams& params) {
  const auto pick = [&](float Softness::*field, Lane& out) {
    select(both_move, F8::set(params.moving.*field), F8::set(params.fixed.*field)).store(out);
  };
  pick(&Softness::bias_rate, r.bias_rate);
  pick(&Softness::mass_scale, r.mass_scale);
  pick(&Softness::impulse_scale, r.impulse_scale);
}

inline F8 effectiveMass(const Batch& c, const V8& ra, const V8& rb, const V8& sa, const V8& sb, F8 axes) {
  const F8 inv_mass = c.a.mass.inv_mass + c.b.mass.inv_mass;
  return axes * inv_mass + dot(ra, c.a.mass.inv_inertia * sa) + dot(rb, c.b.mass.inv_inertia * sb);
}

// Turns what the set-up copied from the manifolds (see ContactPointRows) into rows.
inline void prepare(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 zero = F8::zero(), one = F8::set(1.0f), tiny = F8::set(1e-30f),
           spread = F8::set(params.friction_spread);
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    Batch c(r, bodies);
    const Motion ma = loadMotion(c.a), mb = loadMotion(c.b);  // here: the pose at the start of the step
    const V8 n = V8::load(r.normal), t1 = V8::load(r.tangent), t2 = cross(n, t1);
    // rests on something that does not give way
    const F8 both_move = (c.a.mass.inv_mass * c.b.mass.inv_mass) > zero;
    storeSoftness(r, both_move, params);

    V8 center_a{zero, zero, zero}, center_b = center_a;
    F8 present = zero;
    for (uint32_t i = 0; i < r.num_points; ++i) {
      ContactPointRows& p = r.points[i];
      const F8 exists = F8::load(p.normal_mass);
      const V8 arm_a = rotate(ma.u, ma.q, V8::load(p.arm_a)), arm_b = rotate(mb.u, mb.q, V8::load(p.arm_b));
      arm_a.store(p.arm_a);
      arm_b.store(p.arm_b);
      center_a = center_a + exists * arm_a;
      center_b = center_b + exists * arm_b;
      present += exists;
    }
    const F8 share = one / max(present, one);
    center_a = share * center_a;
    center_b = share * center_b;
    center_a.store(r.center_a);
    center_b.store(r.center_b);

    for (uint32_t i = 0; i < r.num_points; ++i) {
      ContactPointRows& p = r.points[i];
      const F8 exists = F8::load(p.normal_mass) > zero;
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      const V8 na = cross(arm_a, n), nb = cross(arm_b, n);
      const F8 kn = effectiveMass(c, na, nb, na, nb, one);
      ((one / max(kn, tiny)) & (kn > zero) & exists).store(p.normal_mass);
      dot(n, relativeVelocity(c, arm_a, arm_b)).store(p.approach_speed);
      zero.store(p.max_normal_impulse);

      const V8 fa = frictionArm(center_a, arm_a, spread), fb = frictionArm(center_b, arm_b, spread);
      const V8 a1 = cross(fa, t1), a2 = cross(fa, t2), b1 = cross(fb, t1), b2 = cross(fb, t2);
      const F8 k11 = effectiveMass(c, a1, b1, a1, b1, one), k22 = effectiveMass(c, a2, b2, a2, b2, one);
      const F8 k12 = effectiveMass(c, a1, b1, a2, b2, zero);
      const F8 determinant = k11 * k22 - k12 * k12;
      const F8 inverse = (one / max(determinant, tiny)) & (determinant > zero) & exists;
      const V8 impulse = V8::load(p.tangent_mass);  // here: the remembered friction, world axes
      (inverse * k22).store(p.tangent_mass[0]);
      (zero - inverse * k12).store(p.tangent_mass[1]);
      (inverse * k11).store(p.tangent_mass[2]);
      dot(impulse, t1).store(p.tangent_impulse[0]);
      dot(impulse, t2).store(p.tangent_impulse[1]);
    }
  }
}

inline void warmStart(ContactRows* rows, uint32_t count, SolverBody* bodies,
                      const ContactSolveParams& params) {
  const F8 spread = F8::set(params.friction_spread);
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    Batch c(r, bodies);
    const V8 n = V8::load(r.normal), t1 = V8::load(r.tangent), t2 = cross(n, t1);
    const V8 center_a = V8::load(r.center_a), center_b = V8::load(r.center_b);
    for (uint32_t i = 0; i < r.num_points; ++i) {
      const ContactPointRows& p = r.points[i];
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      apply(c, F8::load(p.normal_impulse) * n, arm_a, arm_b);
      const V8 friction = F8::load(p.tangent_impulse[0]) * t1 + F8::load(p.tangent_impulse[1]) * t2;
      apply(c, friction, frictionArm(center_a, arm_a, spread), frictionArm(center_b, arm_b, spread));
    }
    c.store();
  }
}

// Sweeps over the points of a manifold each time it is visited. The four points of a face work against each other; a
// second sweep costs little while everything is at hand, and doubles the stiffness at which stacks stay calm.
inline constexpr int kSweeps = 2;

inline void push(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 inv_h = F8::set(params.inv_h), fastest = F8::set(params.max_push_speed);
  const F8 zero = F8::zero(), one = F8::set(1.0f);
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    Batch c(r, bodies);
    const Motion ma = loadMotion(c.a), mb = loadMotion(c.b);
    const V8 n = V8::load(r.normal), shift = mb.dp - ma.dp;
    const ContactTurn turn_a = contactTurn(ma, n, F8::load(r.turns_a)), turn_b = contactTurn(mb, n, F8::load(r.turns_b));
    const F8 bias_rate = F8::load(r.bias_rate);
    const F8 mass_scale = F8::load(r.mass_scale), impulse_scale = F8::load(r.impulse_scale);
    for (uint32_t sweep = 0; sweep < kSweeps * r.num_points; ++sweep) {
      ContactPointRows& p = r.points[sweep % r.num_points];
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      const F8 s = F8::load(p.separation) + dot(n, shift + (contactShift(turn_b, arm_b) - contactShift(turn_a, arm_a)));
      const F8 apart = s > zero;
      const F8 bias = s * select(apart, inv_h, bias_rate);
      const F8 vn = dot(n, relativeVelocity(c, arm_a, arm_b));
      const F8 old = F8::load(p.normal_impulse);
      const F8 mass = F8::load(p.normal_mass) * select(apart, one, mass_scale);
      const F8 change = -(mass * (vn + bias)) - select(apart, zero, impulse_scale) * old;
      // Whatever the overlap, it opens no faster than this; what the row gives way under its load is not counted.
      const F8 fast = mass * (fastest - vn);
      const F8 impulse = max(old + select(apart, change, min(change, fast)), zero);
      impulse.store(p.normal_impulse);
      apply(c, (impulse - old) * n, arm_a, arm_b);
    }
    c.store();
  }
}

// The lanes of a batch that a kernel works on. What the others carry stays.
struct AllLanes {
  F8 choose(F8 changed, F8) const { return changed; }
};
struct SomeLanes {
  F8 mask;
  F8 choose(F8 changed, F8 old) const { return select(mask, changed, old); }
};

template <class Lanes>
inline void relaxNormals(Batch& c, const V8& n, F8 inv_h, const Lanes& lanes) {
  const Motion ma = loadMotion(c.a), mb = loadMotion(c.b);
  const V8 shift = mb.dp - ma.dp;
  const ContactTurn turn_a = contactTurn(ma, n, F8::load(c.rows.turns_a)),
                    turn_b = contactTurn(mb, n, F8::load(c.rows.turns_b));
  const F8 zero = F8::zero();
  for (uint32_t i = 0; i < c.rows.num_points; ++i) {
    ContactPointRows& p = c.rows.points[i];
    const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
    const F8 s = F8::load(p.separation) + dot(n, shift + (contactShift(turn_b, arm_b) - contactShift(turn_a, arm_a)));
    const F8 vn = dot(n, relativeVelocity(c, arm_a, arm_b));
    const F8 old = F8::load(p.normal_impulse);
    const F8 impulse = lanes.choose(max(old - F8::load(p.normal_mass) * (vn + max(s, zero) * inv_h), zero), old);
    impulse.store(p.normal_impulse);
    max(impulse, F8::load(p.max_normal_impulse)).store(p.max_normal_impulse);
    apply(c, (impulse - old) * n, arm_a, arm_b);
  }
}

// Smaller eigenvalue of a symmetric 2 x 2 matrix.
inline F8 smallerEigenvalue(F8 m11, F8 m12, F8 m22) {
  const F8 difference = m11 - m22, twice = m12 + m12;
  return F8::set(0.5f) * ((m11 + m22) - sqrt(difference * difference + twice * twice));
}

// What sticks is stopped at once by the 2 x 2 block. What slides must be braked against its velocity, but the block turns
// the impulse away from that where the body also turns; there a mass that is the same both ways takes its place, the
// largest for which the projection converges.
template <class Lanes>
inline void solveFriction(Batch& c, const V8& n, F8 spread, const Lanes& lanes) {
  ContactRows& r = c.rows;
  const V8 t1 = V8::load(r.tangent), t2 = cross(n, t1);
  const V8 center_a = V8::load(r.center_a), center_b = V8::load(r.center_b);
  const F8 friction = F8::load(r.friction);
  for (uint32_t i = 0; i < r.num_points; ++i) {
    ContactPointRows& p = r.points[i];
    const V8 arm_a = frictionArm(center_a, V8::load(p.arm_a), spread);
    const V8 arm_b = frictionArm(center_b, V8::load(p.arm_b), spread);
    const V8 v = relativeVelocity(c, arm_a, arm_b);
    const F8 v1 = dot(t1, v), v2 = dot(t2, v);
    const F8 m11 = F8::load(p.tangent_mass[0]), m12 = F8::load(p.tangent_mass[1]),
             m22 = F8::load(p.tangent_mass[2]);
    const F8 old1 = F8::load(p.tangent_impulse[0]), old2 = F8::load(p.tangent_impulse[1]);
    F8 x1 = old1 - (m11 * v1 + m12 * v2), x2 = old2 - (m12 * v1 + m22 * v2);
    const F8 limit = friction * F8::load(p.normal_impulse);
    const F8 slides = x1 * x1 + x2 * x2 > limit * limit;
    const F8 mass = smallerEigenvalue(m11, m12, m22);
    x1 = select(slides, old1 - mass * v1, x1);
    x2 = select(slides, old2 - mass * v2, x2);
    const F8 length2 = x1 * x1 + x2 * x2;
    const F8 scale =
        select(length2 > limit * limit, limit / max(sqrt(length2), F8::set(1e-30f)), F8::set(1.0f));
    x1 = lanes.choose(scale * x1, old1), x2 = lanes.choose(scale * x2, old2);
    x1.store(p.tangent_impulse[0]);
    x2.store(p.tangent_impulse[1]);
    apply(c, (x1 - old1) * t1 + (x2 - old2) * t2, arm_a, arm_b);
  }
}

inline void relax(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 inv_h = F8::set(params.inv_h), spread = F8::set(params.friction_spread);
  for (uint32_t k = 0; k < count; ++k) {
    Batch c(rows[k], bodies);
    const V8 n = V8::load(rows[k].normal);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      relaxNormals(c, n, inv_h, AllLanes{});
      solveFriction(c, n, spread, AllLanes{});
    }
    c.store();
  }
}

// Sweeps over the points of a new contact. Nothing is known of its impulses yet, and what the first sub-step does not find
// of the normal ones is missing in the friction too: a box set on a slope would start with a slip. Impacts are no such
// contacts: they are not to be stopped before they bounce.
inline constexpr int kFirstSweeps = 16;

inline F8 comesSlowly(const ContactRows& r, float threshold) {
  F8 fastest = F8::zero();
  for (uint32_t i = 0; i < r.num_points; ++i) fastest = min(fastest, F8::load(r.points[i].approach_speed));
  return fastest > F8::set(-threshold);
}

// Lanes with a point that would be too close after the sub-step. Contacts that bear nothing are always new.
inline F8 isPressed(Batch& c, const V8& n, F8 inv_h) {
  const F8 zero = F8::zero();
  F8 least = zero;
  for (uint32_t i = 0; i < c.rows.num_points; ++i) {
    const ContactPointRows& p = c.rows.points[i];
    const F8 vn = dot(n, relativeVelocity(c, V8::load(p.arm_a), V8::load(p.arm_b)));
    least = min(least, (vn + max(F8::load(p.separation), zero) * inv_h) & (F8::load(p.normal_mass) > zero));
  }
  return least < zero;
}

inline void settle(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 inv_h = F8::set(params.inv_h), spread = F8::set(params.friction_spread);
  for (uint32_t k = 0; k < count; ++k) {
    if (rows[k].is_new == 0) continue;
    Batch c(rows[k], bodies);
    const V8 n = V8::load(rows[k].normal);
    const F8 settles = laneMask(rows[k].is_new) & comesSlowly(rows[k], params.restitution_threshold);
    const SomeLanes lanes{settles & isPressed(c, n, inv_h)};
    if (!anyTrue(lanes.mask)) continue;
    for (int sweep = 0; sweep < kFirstSweeps; ++sweep) {
      relaxNormals(c, n, inv_h, lanes);
      solveFriction(c, n, spread, lanes);
    }
    c.store();
  }
}

inline void restitution(ContactRows* rows, uint32_t count, SolverBody* bodies,
                        const ContactSolveParams& params) {
  const F8 zero = F8::zero(), threshold = F8::set(-params.restitution_threshold);
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    if (!r.has_restitution) continue;
    Batch c(r, bodies);
    const V8 n = V8::load(r.normal);
    const F8 e = F8::load(r.restitution);
    for (uint32_t i = 0; i < r.num_points; ++i) {
      ContactPointRows& p = r.points[i];
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      const F8 approach = F8::load(p.approach_speed);
      const F8 bounces = (approach < threshold) & (F8::load(p.max_normal_impulse) > zero);
      const F8 vn = dot(n, relativeVelocity(c, arm_a, arm_b));
      const F8 old = F8::load(p.normal_impulse);
      const F8 wanted = max(old - F8::load(p.normal_mass) * (vn + e * approach), zero);
      const F8 impulse = select(bounces, wanted, old);
      impulse.store(p.normal_impulse);
      apply(c, (impulse - old) * n, arm_a, arm_b);
    }
    c.store();
  }
}

}  // namespace pfx::PFX_LANES
