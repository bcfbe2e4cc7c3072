#include "pfx/base_level/rigid_body/rotation_update.h"

#include <cmath>

#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

// Angular velocity of a body with momentum l at orientation q.
Vec3 velocityAt(const Quat& q, const Inertia& inertia, const Vec3& l) {
  const Mat3 r = q.toRotationMatrix();
  return r * (inertia.inverse_body * (r.transpose() * l));
}

Quat midpoint(const Quat& q, const Inertia& inertia, const Vec3& l, const Vec3& w, float h) {
  const Quat half = expMap(0.5f * h * w) * q;
  return expMap(h * velocityAt(half, inertia, l)) * q;
}

Quat rungeKuttaMuntheKaas4(const Quat& q, const Inertia& inertia, const Vec3& l, const Vec3& w, float h) {
  const Vec3 k1 = h * w;
  const Vec3 k2 = h * velocityAt(expMap(0.5f * k1) * q, inertia, l);
  const Vec3 k3 = h * velocityAt(expMap(0.5f * k2 - 0.125f * k1.cross(k2)) * q, inertia, l);
  const Vec3 k4 = h * velocityAt(expMap(k3) * q, inertia, l);
  const Vec3 u = (k1 + 2.0f * k2 + 2.0f * k3 + k4) / 6.0f + k4.cross(k1) / 12.0f;
  return expMap(u) * q;
}

}  // namespace

Quat expMap(const Vec3& u) {
  const float angle2 = u.squaredNorm();
  float s, c;  // sin(angle / 2) / angle, cos(angle / 2)
  if (angle2 < 0.25f) {
    // Taylor series in (angle/2)^2; the first term left out is below half an ulp of a float.
    const float x = 0.25f * angle2;
    s = 0.5f * (1.0f - x * (1.0f / 6.0f - x * (1.0f / 120.0f - x * (1.0f / 5040.0f))));
    c = 1.0f - x * (0.5f - x * (1.0f / 24.0f - x * (1.0f / 720.0f)));
  } else {
    const float angle = std::sqrt(angle2);
    const SinCos half = sincos(0.5f * angle);
    s = half.sin / angle;
    c = half.cos;
  }
  return Quat(c, s * u.x(), s * u.y(), s * u.z());
}

Inertia makeInertia(const Mat3& inertia) {
  const Mat3 off = inertia - inertia(0, 0) * Mat3::Identity();
  return {inertia, inertia.inverse(), off.cwiseAbs().maxCoeff() < 1e-6f * inertia(0, 0)};
}

Rotation advanceRotation(const Rotation& start, const Inertia& inertia, float h) {
  const Quat& q = start.orientation;
  const Vec3& w = start.angular_velocity;
  const float turn2 = w.squaredNorm() * h * h;
  if (turn2 == 0.0f) return start;
  if (inertia.spherical || turn2 < 1e-6f) return {(expMap(h * w) * q).normalized(), w};
  const Mat3 r = q.toRotationMatrix();
  const Vec3 l = r * (inertia.body * (r.transpose() * w));
  const Quat moved =
      turn2 < 0.0025f ? midpoint(q, inertia, l, w, h) : rungeKuttaMuntheKaas4(q, inertia, l, w, h);
  const Quat q1 = moved.normalized();
  return {q1, velocityAt(q1, inertia, l)};
}

Mat3 worldInverseInertia(const Quat& orientation, const Inertia& inertia) {
  if (inertia.spherical) return inertia.inverse_body;
  const Mat3 r = orientation.toRotationMatrix();
  return r * inertia.inverse_body * r.transpose();
}

}  // namespace pfx
