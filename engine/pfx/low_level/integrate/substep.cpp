#include "pfx/low_level/integrate/substep.h"

#include <algorithm>

namespace pfx {
namespace {

Vec3 load(const float (&a)[3]) { return Vec3(a[0], a[1], a[2]); }

void store(float (&out)[3], const Vec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

Vec3 symmetricProduct(const float (&m)[6], const Vec3& v) {
  return Vec3(m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
              m[2] * v[0] + m[4] * v[1] + m[5] * v[2]);
}

Quat deltaRotation(const SolverBody& b) { return Quat(b.dq[3], b.dq[0], b.dq[1], b.dq[2]); }

void setDeltaRotation(SolverBody& b, const Quat& q) {
  b.dq[0] = q.x(), b.dq[1] = q.y(), b.dq[2] = q.z(), b.dq[3] = q.w();
}

// A turn below this (rad a sub-step, squared) leaves the world inertia as it is.
constexpr float kNegligibleTurn2 = 1e-8f;

// Changes of velocity up to this many sub-steps of free fall are the work of forces.
constexpr float kSmoothFalls = 4.0f;

// What is slower than this many is at rest or settles, and keeps the damping of the full drift.
constexpr float kMovingFalls = 1.0f;

// What of the lag still holds when the impulses of this sub-step have taken back some of the change it was made from.
Vec3 remainingLag(const BodyMotion& m, const Vec3& v, float h) {
  if (v == m.free_velocity) return 0.5f * h * (v - m.start_velocity);
  const float whole = m.lag.squaredNorm();
  if (whole == 0.0f) return m.lag;
  return std::clamp(0.5f * h * (v - m.start_velocity).dot(m.lag) / whole, 0.0f, 1.0f) * m.lag;
}

// Levers and masses of contacts stay as they were at the start of the step. Where a slender body has turned away from
// them, its small moment about its own axis gets in the way of levers that were along it, and impulses would spin it up
// without end. So the moments that impulses meet are raised, by what keeps the masses of such levers within a third of
// what they were.
constexpr float kCompact = 30.0f;  // slenderness up to which nothing is raised: 9 for a ball, 22 for a box 1 : 1 : 4
constexpr float kRaise = 2.0f;     // of the square of the turn (rad)

Mat3 inverseForImpulses(const SolverBody& b, const Quat& orientation, const Inertia& inertia) {
  const float moments = inertia.body.trace(), slenderness = moments * inertia.inverse_body.trace();
  if (slenderness <= kCompact) return worldInverseInertia(orientation, inertia);
  const float turn2 = 4.0f * (b.dq[0] * b.dq[0] + b.dq[1] * b.dq[1] + b.dq[2] * b.dq[2]);
  const float raise = kRaise * turn2 * 0.5f * moments * (1.0f - kCompact / slenderness);
  const Mat3 r = orientation.toRotationMatrix();
  return r * (inertia.body + raise * Mat3::Identity()).inverse() * r.transpose();
}

Vec3 angularMomentum(const SolverBody& b, const BodyMotion& m, const Vec3& w) {
  if (m.inertia->spherical) return m.inertia->body(0, 0) * w;
  const Mat3 r = (deltaRotation(b) * m.start_orientation).toRotationMatrix();
  return r * (m.inertia->body * (r.transpose() * w));
}

}  // namespace

void setInverseInertia(SolverBody& body, const Mat3& inverse) {
  const float packed[6] = {inverse(0, 0), inverse(0, 1), inverse(0, 2),
                           inverse(1, 1), inverse(1, 2), inverse(2, 2)};
  for (int i = 0; i < 6; ++i) body.inv_inertia[i] = packed[i];
}

void integrateVelocities(std::span<SolverBody> bodies, std::span<BodyMotion> motions, float h) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    SolverBody& b = bodies[i];
    BodyMotion& m = motions[i];
    if (!m.inertia) continue;
    m.start_velocity = load(b.v);
    m.free_velocity = m.linear_decay * (load(b.v) + h * m.acceleration);
    const Vec3 w = m.angular_decay * (load(b.w) + h * symmetricProduct(b.inv_inertia, m.torque));
    m.free_momentum = angularMomentum(b, m, w);
    store(b.v, m.free_velocity + m.impulse_velocity);
    store(b.w, w + symmetricProduct(b.inv_inertia, m.impulse_momentum));
  }
}

void setLag(std::span<const SolverBody> bodies, std::span<BodyMotion> motions, float h) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    BodyMotion& m = motions[i];
    if (!m.keeps_pace) continue;
    m.lag = Vec3::Zero();
    const float gravity2 = m.acceleration.squaredNorm(), fall2 = h * h * gravity2;
    const Vec3 change = load(bodies[i].v) - m.start_velocity;
    if (!(gravity2 > 0.0f) || change.squaredNorm() > kSmoothFalls * kSmoothFalls * fall2) continue;
    if (!(m.start_velocity.squaredNorm() > kMovingFalls * kMovingFalls * fall2)) continue;
    m.lag = 0.5f * h * (change - change.dot(m.acceleration) / gravity2 * m.acceleration);
  }
}

void integratePositions(std::span<SolverBody> bodies, std::span<const BodyMotion> motions, float h) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    SolverBody& b = bodies[i];
    const BodyMotion& m = motions[i];
    const Vec3 v = load(b.v);
    store(b.dp, load(b.dp) + (h * v - (m.keeps_pace ? remainingLag(m, v, h) : m.lag)));
    const Vec3 w = load(b.w);
    if (!m.inertia || m.inertia->spherical || w.squaredNorm() * h * h < kNegligibleTurn2) {
      setDeltaRotation(b, (expMap(h * w) * deltaRotation(b)).normalized());
      continue;
    }
    const Rotation turned = advanceRotation({deltaRotation(b) * m.start_orientation, w}, *m.inertia, h);
    setDeltaRotation(b, turned.orientation * m.start_orientation.conjugate());
    store(b.w, turned.angular_velocity);
    setInverseInertia(b, inverseForImpulses(b, turned.orientation, *m.inertia));
  }
}

void rememberImpulses(std::span<const SolverBody> bodies, std::span<BodyMotion> motions) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    const SolverBody& b = bodies[i];
    BodyMotion& m = motions[i];
    if (!m.inertia) continue;
    m.impulse_velocity = load(b.v) - m.free_velocity;
    m.impulse_momentum = angularMomentum(b, m, load(b.w)) - m.free_momentum;
  }
}

}  // namespace pfx
