#include "pfx/low_level/solver/direct_body.h"

#include <cmath>

#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

// Quaternion of the rotation by |u| radians about u.
Quatd turnBy(const Vec3d& u) {
  const double angle2 = u.squaredNorm();
  double s, c;  // sin(angle / 2) / angle, cos(angle / 2)
  if (angle2 < 1e-2) {
    // Taylor series in (angle / 2)^2; the first term left out is below 1e-17.
    const double x = 0.25 * angle2;
    s = 0.5 * (1.0 - x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0 - x / 362880.0))));
    c = 1.0 - x * (0.5 - x * (1.0 / 24.0 - x * (1.0 / 720.0 - x / 40320.0)));
  } else {
    const double angle = std::sqrt(angle2);
    const SinCosDouble half = sincos(0.5 * angle);
    s = half.sin / angle;
    c = half.cos;
  }
  return Quatd(c, s * u.x(), s * u.y(), s * u.z());
}

Vec3d velocityAt(const Quatd& q, const Mat3d& body_inverse, const Vec3d& l) {
  return q * (body_inverse * (q.conjugate() * l));
}

Quatd rungeKuttaMuntheKaas4(const DirectBody& b, const Vec3d& l, double h) {
  const Quatd& q = b.pose.orientation;
  const Vec3d k1 = h * b.w;
  const Vec3d k2 = h * velocityAt(turnBy(0.5 * k1) * q, b.body_inverse, l);
  const Vec3d k3 = h * velocityAt(turnBy(0.5 * k2 - 0.125 * k1.cross(k2)) * q, b.body_inverse, l);
  const Vec3d k4 = h * velocityAt(turnBy(k3) * q, b.body_inverse, l);
  const Vec3d u = (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0 + k4.cross(k1) / 12.0;
  return turnBy(u) * q;
}

}  // namespace

DirectBody makeDirectBody(const RigidState& s, const RigidBody& body, const BodyMotion& motion) {
  DirectBody b;
  b.pose = toDouble(s.pose());
  b.next = b.pose;
  b.v = s.linear_velocity.cast<double>();
  b.w = s.angular_velocity.cast<double>();
  b.dynamic = motion.inertia != nullptr;
  if (!b.dynamic) return b;
  b.inv_mass = 1.0 / static_cast<double>(body.mass);
  b.body_inertia = motion.inertia->body.cast<double>();
  b.spherical = motion.inertia->spherical;
  if (b.spherical) b.body_inertia = b.body_inertia(0, 0) * Mat3d::Identity();
  b.body_inverse = b.body_inertia.inverse();
  b.acceleration = motion.acceleration.cast<double>();
  b.torque = motion.torque.cast<double>();
  b.linear_decay = motion.linear_decay;
  b.angular_decay = motion.angular_decay;
  return b;
}

void kick(DirectBody& b, double h, double part) {
  if (!b.dynamic) return;
  b.v += part * h * b.acceleration;
  if (!b.torque.isZero(0.0)) b.w += part * h * velocityAt(b.pose.orientation, b.body_inverse, b.torque);
  if (b.linear_decay != 1.0) b.v *= part == 1.0 ? b.linear_decay : std::sqrt(b.linear_decay);
  if (b.angular_decay != 1.0) b.w *= part == 1.0 ? b.angular_decay : std::sqrt(b.angular_decay);
}

void predict(DirectBody& b, double h) {
  b.next.position = b.pose.position + h * b.v;
  const Quatd& q = b.pose.orientation;
  const double turn2 = b.w.squaredNorm() * h * h;
  if (b.spherical || turn2 == 0.0) {
    b.next.orientation = (turnBy(h * b.w) * q).normalized();
    b.next_w = b.w;
    return;
  }
  const Vec3d l = q * (b.body_inertia * (q.conjugate() * b.w));
  if (turn2 < 0.0025) {
    const Quatd half = turnBy(0.5 * h * b.w) * q;
    b.next.orientation = (turnBy(h * velocityAt(half, b.body_inverse, l)) * q).normalized();
  } else {
    b.next.orientation = rungeKuttaMuntheKaas4(b, l, h).normalized();
  }
  b.next_w = velocityAt(b.next.orientation, b.body_inverse, l);
}

double stiffnessRatio(const DirectBody& b, double h) {
  if (!b.dynamic) return 0.0;
  const Mat3d r = b.pose.orientation.toRotationMatrix();
  const Mat3d k = r.transpose() * b.stiffness * r;
  const Vec3d root = b.body_inertia.diagonal().cwiseSqrt();
  return h * h * k.cwiseQuotient(root * root.transpose()).cwiseAbs().maxCoeff();
}

void updateInverseInertia(DirectBody& b, double h, bool stiffen) {
  if (!b.dynamic) return;
  if (!stiffen && b.spherical) {
    b.inverse = b.body_inverse;
    return;
  }
  const Mat3d r = b.pose.orientation.toRotationMatrix();
  if (!stiffen) {
    b.inverse = r * b.body_inverse * r.transpose();
    return;
  }
  Mat3d inertia = b.body_inertia;
  inertia.diagonal() += h * h * (r.transpose() * b.stiffness * r).colwise().norm().transpose();
  b.inverse = r * inertia.inverse() * r.transpose();
}

}  // namespace pfx
