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

// The least moment of inertia that two bodies set against a turn, by the largest row sum of their inverse.
inline F8 turningMass(const Batch& c) {
  const S8 &a = c.a.mass.inv_inertia, &b = c.b.mass.inv_inertia;
  const auto size = [](F8 x) { return max(x, F8::zero() - x); };
  const F8 xy = size(a.xy + b.xy), xz = size(a.xz + b.xz), yz = size(a.yz + b.yz);
  const F8 most = max(max(a.xx + b.xx + xy + xz, a.yy + b.yy + xy + yz), a.zz + b.zz + xz + yz);
  return (F8::set(1.0f) / max(most, F8::set(1e-30f))) & (most > F8::zero());
}

// Turns what the set-up copied from the manifolds (see ContactPointRows) into rows.
inline void prepare(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 zero = F8::zero(), one = F8::set(1.0f), tiny = F8::set(1e-30f);
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    Batch c(r, bodies);
    const Motion ma = loadMotion(c.a), mb = loadMotion(c.b);  // here: the pose at the start of the step
    const V8 n = V8::load(r.normal), t1 = V8::load(r.tangent), t2 = cross(n, t1);
    const F8 spread = F8::load(r.friction_spread);
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
    if (r.rolling) turningMass(c).store(r.rolling->mass);

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

inline void warmStart(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams&) {
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    Batch c(r, bodies);
    const F8 spread = F8::load(r.friction_spread);
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

// The lanes of a batch that a kernel works on. What the others carry stays.
struct AllLanes {
  F8 choose(F8 changed, F8) const { return changed; }
  F8 frictionLimit2(F8 limit2, F8) const { return limit2; }
};
struct SomeLanes {
  F8 mask;
  F8 choose(F8 changed, F8 old) const { return select(mask, changed, old); }
  F8 frictionLimit2(F8 limit2, F8) const { return limit2; }
};
// While overlaps are pushed apart, normal impulses are not those that bear; friction is held against what it was.
struct SlidingLanes {
  F8 mask;
  F8 choose(F8 changed, F8 old) const { return select(mask, changed, old); }
  F8 frictionLimit2(F8, F8 old2) const { return old2; }
};

// What is going to bounce is not to be slowed down before it has reached the surface.
struct Bounce {
  F8 inv_h;
  F8 threshold;  // m/s, of the approach
};
inline F8 isYetToHit(const ContactRows& r, F8 separation, F8 vn, const Bounce& bounce) {
  constexpr float kTouching = 0.01f;  // of the way of a sub-step
  const F8 approach = F8::zero() - vn;
  return (F8::load(r.restitution) > F8::zero()) & (approach > bounce.threshold) &
         (separation * bounce.inv_h > F8::set(kTouching) * approach);
}

template <class Lanes>
inline void relaxNormals(Batch& c, const V8& n, const Bounce& bounce, const Lanes& lanes) {
  const F8 inv_h = bounce.inv_h;
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
    F8 found = max(old - F8::load(p.normal_mass) * (vn + max(s, zero) * inv_h), zero);
    if (c.rows.has_restitution) found = select(isYetToHit(c.rows, s, vn, bounce), zero, found);
    const F8 impulse = lanes.choose(found, old);
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
inline void solveFriction(Batch& c, const V8& n, const Lanes& lanes) {
  ContactRows& r = c.rows;
  const F8 spread = F8::load(r.friction_spread);
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
    const F8 cone = friction * F8::load(p.normal_impulse);
    const F8 limit2 = lanes.frictionLimit2(cone * cone, old1 * old1 + old2 * old2);
    const F8 slides = x1 * x1 + x2 * x2 > limit2;
    const F8 mass = smallerEigenvalue(m11, m12, m22);
    x1 = select(slides, old1 - mass * v1, x1);
    x2 = select(slides, old2 - mass * v2, x2);
    const F8 length2 = x1 * x1 + x2 * x2;
    const F8 scale = select(length2 > limit2, sqrt(limit2) / max(sqrt(length2), F8::set(1e-30f)), F8::set(1.0f));
    x1 = lanes.choose(scale * x1, old1), x2 = lanes.choose(scale * x2, old2);
    x1.store(p.tangent_impulse[0]);
    x2.store(p.tangent_impulse[1]);
    apply(c, (x1 - old1) * t1 + (x2 - old2) * t2, arm_a, arm_b);
  }
}

// Torques that resist turning: a circle of those across the normal, and one about it, both as wide as the load.
inline void resistTurning(Batch& c, const V8& n) {
  RollingRows& r = *c.rows.rolling;
  F8 load = F8::zero();
  for (uint32_t i = 0; i < c.rows.num_points; ++i) load += F8::load(c.rows.points[i].normal_impulse);
  const V8 old = V8::load(r.impulse);
  const V8 wanted = old - F8::load(r.mass) * (c.b.velocity.w - c.a.velocity.w);
  const F8 about = dot(wanted, n), twist = F8::load(r.torsional) * load, roll = F8::load(r.rolling) * load;
  const V8 across = wanted - about * n;
  const F8 length = sqrt(dot(across, across));
  const F8 share = select(length > roll, roll / max(length, F8::set(1e-30f)), F8::set(1.0f));
  const V8 impulse = share * across + max(min(about, twist), F8::zero() - twist) * n;
  impulse.store(r.impulse);
  c.a.velocity.w = c.a.velocity.w - c.a.mass.inv_inertia * (impulse - old);
  c.b.velocity.w = c.b.velocity.w + c.b.mass.inv_inertia * (impulse - old);
}

// Lanes with a point whose friction is at its limit. What such friction did in the last sub-step may be more than what is
// left to stop, and would drive a body back that comes to rest; so it is solved before the drift as well.
inline F8 slidingLanes(const ContactRows& r) {
  constexpr float kAtLimit = 0.999f;  // of the squared limit
  const F8 zero = F8::zero(), friction = F8::load(r.friction);
  F8 sliding = zero;
  for (uint32_t i = 0; i < r.num_points; ++i) {
    const ContactPointRows& p = r.points[i];
    const F8 x1 = F8::load(p.tangent_impulse[0]), x2 = F8::load(p.tangent_impulse[1]);
    const F8 limit = friction * F8::load(p.normal_impulse), length2 = x1 * x1 + x2 * x2;
    sliding = sliding | ((length2 > zero) & (length2 > F8::set(kAtLimit) * (limit * limit)));
  }
  return sliding;
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
    const F8 slides = slidingLanes(r);
    F8 jammed = zero;  // so deep that friction would only hold together what has to come apart
    for (uint32_t sweep = 0; sweep < kSweeps * r.num_points; ++sweep) {
      ContactPointRows& p = r.points[sweep % r.num_points];
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      const F8 s = F8::load(p.separation) + dot(n, shift + (contactShift(turn_b, arm_b) - contactShift(turn_a, arm_a)));
      const F8 apart = s > zero;
      const F8 bias = s * select(apart, inv_h, bias_rate);
      jammed = jammed | (bias < zero - fastest);
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
    const SlidingLanes sliding{select(jammed, zero, slides)};
    if (anyTrue(sliding.mask)) solveFriction(c, n, sliding);
    c.store();
  }
}

inline void relax(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const Bounce bounce{F8::set(params.inv_h), F8::set(params.restitution_threshold)};
  for (uint32_t k = 0; k < count; ++k) {
    Batch c(rows[k], bodies);
    const V8 n = V8::load(rows[k].normal);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      relaxNormals(c, n, bounce, AllLanes{});
      solveFriction(c, n, AllLanes{});
      if (rows[k].rolling) resistTurning(c, n);
    }
    c.store();
  }
}

// Points of a contact that hit are solved together, with their friction, in this many sweeps.
inline constexpr int kImpactSweeps = 8;

// An impact within the coming sub-step, by lane.
struct Impact {
  F8 hits;      // mask
  F8 time;      // s, from the start of the sub-step
  F8 approach;  // m/s, the fastest of its points
};

// A point on its way to the surface: separation s, normal velocity vn at the start of the sub-step.
struct Approach {
  F8 s, vn, surface_speed;  // m, m/s; the last one where the surfaces meet: v'^2 = v^2 - 2 a s
};

inline Approach approachOf(const Batch& c, const ContactPointRows& p, const V8& n, const ContactTurn& turn_a,
                           const ContactTurn& turn_b, const V8& shift) {
  const F8 zero = F8::zero(), fall = F8::load(c.rows.fall);
  const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
  const F8 s = F8::load(p.separation) + dot(n, shift + (contactShift(turn_b, arm_b) - contactShift(turn_a, arm_a)));
  const F8 vn = dot(n, relativeVelocity(c, arm_a, arm_b));
  return {s, vn, sqrt(max(vn * vn - F8::set(2.0f) * fall * max(s, zero), zero))};
}

// A point is taken to hit by the same measure by which push() would stop it. What is deeper than its way of a step did not
// just meet the surface.
inline constexpr float kDeepest = 4.0f;  // ways of a sub-step

inline Impact findImpact(const Batch& c, const Approach (&points)[4], const ContactSolveParams& params) {
  constexpr float kEarly = 1e-3f;  // of the way of a sub-step
  const F8 zero = F8::zero(), h = F8::set(1.0f / params.inv_h), fall = F8::load(c.rows.fall);
  const F8 may = laneMask(c.rows.bounces_in_order) & (F8::load(c.rows.restitution) > zero);
  Impact impact{zero, F8::set(1.5f) * h, zero};
  for (uint32_t i = 0; i < c.rows.num_points; ++i) {
    const Approach& a = points[i];
    const F8 exists = F8::load(c.rows.points[i].normal_mass) > zero;
    const F8 reaches = (a.s + h * (a.vn + fall * h) < F8::set(kEarly) * (h * (zero - a.vn))) & (a.s > F8::set(kDeepest) * (h * a.vn));
    const F8 hits = may & exists & (a.vn < F8::set(-params.restitution_threshold)) & reaches;
    const F8 time = F8::set(2.0f) * max(a.s, zero) / max(a.surface_speed - a.vn, F8::set(1e-30f));
    impact.time = select(hits, min(impact.time, time), impact.time);
    impact.approach = select(hits, max(impact.approach, zero - a.vn), impact.approach);
    impact.hits = impact.hits | hits;
  }
  return impact;
}

// The masses of rows are those of the start of the step. Here, where sweeps go on until the answer is there, they have to be
// those of the bodies as they have turned since.
inline F8 massNow(const Batch& c, const V8& n, const V8& arm_a, const V8& arm_b) {
  const V8 na = cross(arm_a, n), nb = cross(arm_b, n);
  const F8 k = effectiveMass(c, na, nb, na, nb, F8::set(1.0f));
  return (F8::set(1.0f) / max(k, F8::set(1e-30f))) & (k > F8::zero());
}

// The same along the tangents, the one that is right for both.
inline F8 tangentMassNow(const Batch& c, const V8& t1, const V8& t2, const V8& arm_a, const V8& arm_b) {
  const V8 a1 = cross(arm_a, t1), a2 = cross(arm_a, t2), b1 = cross(arm_b, t1), b2 = cross(arm_b, t2);
  const F8 one = F8::set(1.0f), half = F8::set(0.5f);
  const F8 k11 = effectiveMass(c, a1, b1, a1, b1, one), k22 = effectiveMass(c, a2, b2, a2, b2, one);
  const F8 twice = F8::set(2.0f) * effectiveMass(c, a1, b1, a2, b2, F8::zero()), difference = k11 - k22;
  const F8 k = half * ((k11 + k22) + sqrt(difference * difference + twice * twice));
  return (one / max(k, F8::set(1e-30f))) & (k > F8::zero());
}

// Friction of an impact at a point; x: its impulses along the tangents so far.
inline void rub(Batch& c, const ContactPointRows& p, const V8& n, F8 limit, F8 (&x)[2]) {
  const ContactRows& r = c.rows;
  const V8 t1 = V8::load(r.tangent), t2 = cross(n, t1);
  const F8 spread = F8::load(r.friction_spread);
  const V8 arm_a = frictionArm(V8::load(r.center_a), V8::load(p.arm_a), spread);
  const V8 arm_b = frictionArm(V8::load(r.center_b), V8::load(p.arm_b), spread);
  const V8 v = relativeVelocity(c, arm_a, arm_b);
  const F8 mass = tangentMassNow(c, t1, t2, arm_a, arm_b);
  F8 x1 = x[0] - mass * dot(t1, v), x2 = x[1] - mass * dot(t2, v);
  const F8 length = sqrt(x1 * x1 + x2 * x2);
  const F8 scale = select(length > limit, limit / max(length, F8::set(1e-30f)), F8::set(1.0f));
  x1 = scale * x1, x2 = scale * x2;
  apply(c, (x1 - x[0]) * t1 + (x2 - x[1]) * t2, arm_a, arm_b);
  x[0] = x1, x[1] = x2;
}

// The points that touch at the time of the impact leave with restitution times the speed at which they met.
inline void strike(Batch& c, const V8& n, const Impact& impact, const Approach (&points)[4], F8 h) {
  constexpr float kTogether = 0.02f;  // of the way of a sub-step
  const F8 zero = F8::zero(), half = F8::set(0.5f), one = F8::set(1.0f);
  const F8 fall = F8::load(c.rows.fall), e = F8::load(c.rows.restitution), friction = F8::load(c.rows.friction);
  F8 impulse[4] = {zero, zero, zero, zero}, tangent[4][2] = {{zero, zero}, {zero, zero}, {zero, zero}, {zero, zero}};
  for (int sweep = 0; sweep < kImpactSweeps; ++sweep) {
    for (uint32_t i = 0; i < c.rows.num_points; ++i) {
      const ContactPointRows& p = c.rows.points[i];
      const Approach& a = points[i];
      const F8 then = a.s + impact.time * (a.vn + half * (fall * impact.time));
      const F8 way = h * impact.approach;
      const F8 takes_part = impact.hits & (then < F8::set(kTogether) * way) & (then > zero - F8::set(kDeepest) * way);
      const F8 bounced = a.vn + (one + e) * a.surface_speed;
      const F8 wanted = select(a.vn < zero, max(bounced, zero), zero);
      const V8 arm_a = V8::load(p.arm_a), arm_b = V8::load(p.arm_b);
      const F8 vn = dot(n, relativeVelocity(c, arm_a, arm_b));
      const F8 exists = F8::load(p.normal_mass) > zero;
      const F8 found = max(impulse[i] - massNow(c, n, arm_a, arm_b) * (vn - wanted), zero) & takes_part & exists;
      apply(c, (found - impulse[i]) * n, arm_a, arm_b);
      impulse[i] = found;
      rub(c, p, n, friction * found, tangent[i]);
    }
  }
}

// Moves a body to where it would have to start to be on its new way: the old one up to the impact was another. Its turn
// is left: a slender body that is turned against its spin would be spun up by the ratio of its moments.
inline void moveBack(const Side& side, const V8& velocity_before, F8 time, uint32_t writable) {
  const Motion m = loadMotion(side);
  const V8 dp = m.dp - time * (side.velocity.v - velocity_before);
  float* rows[8];
  for (int i = 0; i < 8; ++i) rows[i] = writable >> i & 1 ? side.bodies[i]->dp : nullptr;
  const F8 t[8] = {dp.x, dp.y, dp.z, F8::zero(), m.u.x, m.u.y, m.u.z, m.q};
  storeTransposed(t, rows);
}

// Whether any point of a batch moves towards its surface fast enough to bounce.
inline bool approachesFast(const Batch& c, const V8& n, float threshold) {
  F8 fastest = F8::zero();
  for (uint32_t i = 0; i < c.rows.num_points; ++i) {
    const ContactPointRows& p = c.rows.points[i];
    fastest = min(fastest, dot(n, relativeVelocity(c, V8::load(p.arm_a), V8::load(p.arm_b))));
  }
  return anyTrue((fastest < F8::set(-threshold)) & laneMask(c.rows.bounces_in_order));
}

inline void bounce(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  for (uint32_t k = 0; k < count; ++k) {
    ContactRows& r = rows[k];
    r.has_bounced = 0;
    if (r.bounces_in_order == 0) continue;
    Batch c(r, bodies);
    const V8 n = V8::load(r.normal);
    if (!approachesFast(c, n, params.restitution_threshold)) continue;
    const Motion ma = loadMotion(c.a), mb = loadMotion(c.b);
    const V8 shift = mb.dp - ma.dp;
    const ContactTurn turn_a = contactTurn(ma, n, F8::load(r.turns_a)), turn_b = contactTurn(mb, n, F8::load(r.turns_b));
    Approach points[4];
    for (uint32_t i = 0; i < r.num_points; ++i) points[i] = approachOf(c, r.points[i], n, turn_a, turn_b, shift);
    const Impact impact = findImpact(c, points, params);
    if (!anyTrue(impact.hits)) continue;
    r.has_bounced = 1;
    const V8 before_a = c.a.velocity.v, before_b = c.b.velocity.v;
    strike(c, n, impact, points, F8::set(1.0f / params.inv_h));
    c.store();
    const F8 time = impact.time & impact.hits;
    moveBack(c.a, before_a, time, r.writable_a);
    moveBack(c.b, before_b, time, r.writable_b);
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

// Resistance to turning is not remembered from step to step.
inline F8 resistsTurning(const RollingRows& r) { return (F8::load(r.rolling) + F8::load(r.torsional)) > F8::zero(); }

inline void settle(ContactRows* rows, uint32_t count, SolverBody* bodies, const ContactSolveParams& params) {
  const F8 inv_h = F8::set(params.inv_h);
  for (uint32_t k = 0; k < count; ++k) {
    if (rows[k].is_new == 0 && !rows[k].rolling) continue;
    Batch c(rows[k], bodies);
    const V8 n = V8::load(rows[k].normal);
    const F8 slow = comesSlowly(rows[k], params.restitution_threshold);
    F8 settles = laneMask(rows[k].is_new) & slow & isPressed(c, n, inv_h);
    if (rows[k].rolling) settles = settles | (slow & resistsTurning(*rows[k].rolling));
    const SomeLanes lanes{settles};
    if (!anyTrue(lanes.mask)) continue;
    const Bounce bounce{inv_h, F8::set(params.restitution_threshold)};
    for (int sweep = 0; sweep < kFirstSweeps; ++sweep) {
      relaxNormals(c, n, bounce, lanes);
      solveFriction(c, n, lanes);
      if (rows[k].rolling) resistTurning(c, n);
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
