#include "pfx/base_level/joint/joint_coordinates.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/joint/gear_angles.h"
#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

// Below this squared sine of the half angle, three terms of the series of asin are exact to 1e-15.
constexpr double kSmallSwing2 = 1e-5;

struct Frames {
  Vec3d arm_a, arm_b;  // from the centres of mass to the anchors, world axes
  Vec3d separation;    // anchor B - anchor A
  Quatd frame_a;       // joint axes of A in the world
};

Frames framesOf(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  Frames f;
  f.arm_a = a.orientation * j.anchor_a.cast<double>();
  f.arm_b = b.orientation * j.anchor_b.cast<double>();
  f.separation = (b.position - a.position) + (f.arm_b - f.arm_a);
  f.frame_a = a.orientation * j.frame_a.cast<double>();
  return f;
}

struct Swing {
  double y, z, w;  // its quaternion; x is zero
  double sine2;    // y^2 + z^2
};

Swing swingOf(const Quatd& q) {
  const double s = std::sqrt(q.x() * q.x() + q.w() * q.w());
  if (s < 1e-12)
    return {q.y(), q.z(), 0.0, q.y() * q.y() + q.z() * q.z()};  // half a turn: no twist is defined
  const double c = q.w() / s, d = q.x() / s;
  const double y = q.y() * c - q.z() * d, z = q.z() * c + q.y() * d;
  return {y, z, s, y * y + z * z};
}

double twistOf(const Quatd& q) { return 2.0 * atan2(q.x(), q.w()); }

// Angle of the swing over the sine of its half.
double anglePerSine(const Swing& s) {
  if (s.sine2 < kSmallSwing2) return 2.0 + s.sine2 * (1.0 / 3.0 + s.sine2 * (3.0 / 20.0));
  const double sine = std::sqrt(s.sine2);
  return 2.0 * atan2(sine, s.w) / sine;
}

Quatd relativeRotation(const Joint& j, const Quatd& frame_a, const TransformDouble& b) {
  Quatd q = frame_a.conjugate() * (b.orientation * j.frame_b.cast<double>());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

bool usesRotation(const Joint& j) {
  return isConstrained(j.axis[3]) || isConstrained(j.axis[4]) || isConstrained(j.axis[5]);
}

void measureRotation(const Joint& j, const Quatd& q, JointCoordinates& out) {
  const Swing s = swingOf(q);
  const double scale = anglePerSine(s);
  out.value[3] = isConstrained(j.axis[3]) ? twistOf(q) : 0.0;
  out.value[4] = j.cone ? scale * std::sqrt(s.sine2) : scale * s.y;
  out.value[5] = j.cone ? 0.0 : scale * s.z;
}

void setRow(double (&row)[6], const Vec3d& linear, const Vec3d& angular) {
  for (int i = 0; i < 3; ++i) row[i] = linear[i], row[3 + i] = angular[i];
}

void setRotationRow(JointJacobian& m, int axis, const Vec3d& direction) {
  setRow(m.a[axis], Vec3d::Zero(), -direction);
  setRow(m.b[axis], Vec3d::Zero(), direction);
}

// Axes of the frame half way along the swing; see the head of joint_coordinates.h.
void linearizeRotation(const Joint& j, const Quatd& frame_a, const Quatd& q, JointJacobian& m) {
  const Swing s = swingOf(q);
  const Quatd half = Quatd(1.0 + s.w, 0.0, s.y, s.z).normalized();
  const Mat3d axes = (frame_a * half).toRotationMatrix();
  setRotationRow(m, 3, axes.col(0) / std::max(1.0 - 2.0 * (half.y() * half.y() + half.z() * half.z()), 1e-6));
  if (j.cone) {
    const double sine = std::sqrt(s.sine2);
    const Vec3d direction = sine > 1e-12 ? Vec3d(0.0, s.y / sine, s.z / sine) : Vec3d(Vec3d::UnitY());
    setRotationRow(m, 4, frame_a * direction);
    setRotationRow(m, 5, Vec3d::Zero());
    return;
  }
  setRotationRow(m, 4, axes.col(1));
  setRotationRow(m, 5, axes.col(2));
}

Vec3d distanceDirection(const Vec3d& separation) {
  const double length = separation.norm();
  return length > 1e-12 ? Vec3d(separation / length) : Vec3d(Vec3d::UnitY());
}

void linearizeTranslation(const Joint& j, const Frames& f, JointJacobian& m) {
  if (j.kind == JointKind::Distance) {
    const Vec3d n = distanceDirection(f.separation);
    setRow(m.a[0], -n, -f.arm_a.cross(n));
    setRow(m.b[0], n, f.arm_b.cross(n));
    return;
  }
  const Mat3d axes = f.frame_a.toRotationMatrix();
  const Vec3d arm_a = f.arm_a + f.separation;  // the axes turn with A about its centre
  for (int i = 0; i < 3; ++i) {
    const Vec3d n = axes.col(i);
    setRow(m.a[i], -n, -arm_a.cross(n));
    setRow(m.b[i], n, f.arm_b.cross(n));
  }
}

// The angle, by whole turns nearest to `near`.
double nearest(double angle, double near) {
  const double turns = std::floor((angle - near) / (2.0 * kPiDouble) + 0.5);
  return angle - turns * 2.0 * kPiDouble;
}

Vec3d gearAxis(const Quat& frame, const TransformDouble& body) {
  return body.orientation * (frame.cast<double>() * Vec3d::UnitX());
}

JointLinearization linearizeGear(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  JointLinearization out = {};
  out.coordinates.value[3] = gearCoordinate(j, gearAngles(j, a, b));
  setRow(out.jacobian.a[3], Vec3d::Zero(), static_cast<double>(j.gear_ratio) * gearAxis(j.frame_a, a));
  setRow(out.jacobian.b[3], Vec3d::Zero(), gearAxis(j.frame_b, b));
  return out;
}

}  // namespace

GearAngles gearAnglesNear(const Joint& j, const TransformDouble& a, const TransformDouble& b, const GearAngles& near) {
  const auto angle = [](const Quat& zero, const Quatd& now, const Quat& frame) {
    return twistOf(zero.cast<double>().conjugate() * now * frame.cast<double>());
  };
  return {nearest(angle(j.gear_zero_a, a.orientation, j.frame_a), near.a),
          nearest(angle(j.gear_zero_b, b.orientation, j.frame_b), near.b)};
}

GearAngles gearAngles(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  return gearAnglesNear(j, a, b, {j.gear_angle_a, j.gear_angle_b});
}

double gearCoordinate(const Joint& j, const GearAngles& angles) { return j.gear_ratio * angles.a + angles.b; }

GearAngles gearRates(const Joint& j, const TransformDouble& a, const Vec3d& wa, const TransformDouble& b,
                     const Vec3d& wb) {
  return {gearAxis(j.frame_a, a).dot(wa), gearAxis(j.frame_b, b).dot(wb)};
}

JointCoordinates measureJoint(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  JointCoordinates out = {};
  if (j.kind == JointKind::Gear) {
    out.value[3] = gearCoordinate(j, gearAngles(j, a, b));
    return out;
  }
  const Frames f = framesOf(j, a, b);
  if (j.kind == JointKind::Distance) {
    out.value[0] = f.separation.norm();
    return out;
  }
  const Vec3d local = f.frame_a.conjugate() * f.separation;
  for (int i = 0; i < 3; ++i) out.value[i] = local[i];
  if (usesRotation(j)) measureRotation(j, relativeRotation(j, f.frame_a, b), out);
  return out;
}

JointLinearization linearizeJoint(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  if (j.kind == JointKind::Gear) return linearizeGear(j, a, b);
  JointLinearization out = {};
  const Frames f = framesOf(j, a, b);
  linearizeTranslation(j, f, out.jacobian);
  if (j.kind == JointKind::Distance) {
    out.coordinates.value[0] = f.separation.norm();
    return out;
  }
  const Vec3d local = f.frame_a.conjugate() * f.separation;
  for (int i = 0; i < 3; ++i) out.coordinates.value[i] = local[i];
  if (!usesRotation(j)) return out;
  const Quatd q = relativeRotation(j, f.frame_a, b);
  measureRotation(j, q, out.coordinates);
  linearizeRotation(j, f.frame_a, q, out.jacobian);
  return out;
}

double axisError(const AxisConstraint& axis, double x) {
  if (axis.lock == JointLock::Free || axis.weight <= 0.0f) return 0.0;
  if (axis.lock == JointLock::Fixed) return x - axis.lower;
  return std::min(x - axis.lower, 0.0) + std::max(x - axis.upper, 0.0);
}

JointError jointError(const Joint& j, const TransformDouble& a, const TransformDouble& b) {
  const JointCoordinates c = measureJoint(j, a, b);
  double squares[2] = {0.0, 0.0};
  for (int i = 0; i < kNumJointAxes; ++i) {
    const double e = axisError(j.axis[i], c.value[i]);
    squares[i / 3] += e * e;
  }
  return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

}  // namespace pfx
