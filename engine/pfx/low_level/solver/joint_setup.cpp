#include "pfx/low_level/solver/joint_setup.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/joint/joint_coordinates.h"
#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

constexpr double kReferenceRate = 60.0;  // 1/s: damping is given as a share a sixtieth of a second

// Share of the error of a gear that a sub-step takes back. Its bodies turn too far in a step for the error to be followed
// from their motion as that of other rows is.
constexpr double kGearCorrection = 0.2;

void setLane(Lane (&out)[3], int lane, const Vec3d& v) {
  for (int i = 0; i < 3; ++i) out[i][lane] = static_cast<float>(v[i]);
}

bool isFixed(const AxisConstraint& c) {
  return c.lock == JointLock::Fixed || (c.lock == JointLock::Limit && c.lower == c.upper);
}

bool hasLock(const AxisConstraint& c) { return c.weight > 0.0f && c.lock != JointLock::Free; }

bool hasDrive(const AxisConstraint& c) {
  return c.weight > 0.0f && !isFixed(c) &&
         (c.damping > 0.0f || c.motor_max_force > 0.0f || c.spring_frequency > 0.0f);
}

// Limits and drives of one axis are two rows, lock first.
template <class Fn>
void forAxisRows(const Joint& j, Fn&& fn) {
  const bool point = hasPointPart(j);
  for (int axis = point ? 3 : 0; axis < kNumJointAxes; ++axis) {
    if (hasLock(j.axis[axis])) fn(axis, false);
    if (hasDrive(j.axis[axis])) fn(axis, true);
  }
}

void fillPoint(const Joint& j, const JointSide& a, const JointSide& b, float h, bool warm_start,
               const JointLane& to) {
  JointBatch& batch = to.batch;
  const Vec3d arm_a = a.pose.orientation * j.anchor_a.cast<double>();
  const Vec3d arm_b = b.pose.orientation * j.anchor_b.cast<double>();
  setLane(batch.arm_a, to.lane, arm_a);
  setLane(batch.arm_b, to.lane, arm_b);
  setLane(batch.separation, to.lane, (b.pose.position - a.pose.position) + (arm_b - arm_a));
  batch.has_point = 1;
  batch.point_weight[to.lane] = j.axis[0].weight;
  batch.point_bias[to.lane] = j.axis[0].bias;
  batch.max_point_impulse[to.lane] = std::min(j.axis[0].max_force * h, 1e18f);
  if (!warm_start) return;
  const Vec3d force(j.axis[0].force, j.axis[1].force, j.axis[2].force);
  setLane(batch.point_impulse, to.lane, h * (a.pose.orientation * (j.frame_a.cast<double>() * force)));
}

void setDrive(const AxisConstraint& c, double value, double mobility, float h, JointAxisRows& r, int lane) {
  r.is_drive[lane] = 1.0f;
  r.max_impulse[lane] = c.motor_max_force > 0.0f ? c.motor_max_force * h : 1e18f;
  if (c.spring_frequency > 0.0f) {
    const double w = 2.0 * kPiDouble * c.spring_frequency;
    const double factor = h * (2.0 * c.spring_damping * w + h * w * w) / mobility;
    r.compliance[lane] = static_cast<float>(1.0 / factor);
    r.target_speed[lane] = static_cast<float>(-h * w * w / mobility * (value - c.spring_target) / factor);
  } else if (c.motor_max_force > 0.0f) {
    r.target_speed[lane] = c.motor_speed;
  } else {
    const double left = c.damping < 1.0f ? exp(kReferenceRate * h * log(1.0 - c.damping)) : 0.0;
    r.compliance[lane] = static_cast<float>(mobility * left / (1.0 - left));
  }
}

}  // namespace

bool hasPointPart(const Joint& j) {
  if (j.kind == JointKind::Distance || j.kind == JointKind::Gear) return false;
  for (int i = 0; i < 3; ++i) {
    const AxisConstraint& c = j.axis[i];
    if (!isFixed(c) || c.lower != 0.0f || c.weight != j.axis[0].weight || c.bias != j.axis[0].bias)
      return false;
  }
  return j.axis[0].weight > 0.0f;
}

uint32_t numAxisRows(const Joint& j) {
  uint32_t n = 0;
  forAxisRows(j, [&](int, bool) { ++n; });
  return n;
}

void fillJointLane(const Joint& j, const JointSide& a, const JointSide& b, float h, bool warm_start,
                   const JointLane& to) {
  if (hasPointPart(j)) fillPoint(j, a, b, h, warm_start, to);
  if (to.rows.empty() || numAxisRows(j) == 0) return;
  const JointLinearization l = linearizeJoint(j, a.pose, b.pose);
  uint32_t next = 0;
  forAxisRows(j, [&](int axis, bool drive) {
    const AxisConstraint& c = j.axis[axis];
    JointAxisRows& r = to.rows[next++];
    const double(&ja)[6] = l.jacobian.a[axis];
    const double(&jb)[6] = l.jacobian.b[axis];
    const Vec3d linear(jb[0], jb[1], jb[2]), angular_a(ja[3], ja[4], ja[5]), angular_b(jb[3], jb[4], jb[5]);
    setLane(r.linear, to.lane, linear);
    setLane(r.angular_a, to.lane, angular_a);
    setLane(r.angular_b, to.lane, angular_b);
    const double mobility = (a.inv_mass + b.inv_mass) * linear.squaredNorm() +
                            angular_a.dot(a.inv_inertia * angular_a) +
                            angular_b.dot(b.inv_inertia * angular_b);
    r.mass[to.lane] = mobility > 1e-30 ? static_cast<float>(c.weight / mobility) : 0.0f;
    r.value[to.lane] = static_cast<float>(l.coordinates.value[axis]);
    r.lower[to.lane] = c.lower;
    r.upper[to.lane] = isFixed(c) ? c.lower : c.upper;
    r.bias[to.lane] = c.bias;
    r.max_impulse[to.lane] = std::min(c.max_force * h, 1e18f);
    if (drive) setDrive(c, l.coordinates.value[axis], mobility, h, r, to.lane);
    if (j.kind == JointKind::Gear) {
      r.is_drive[to.lane] = 1.0f;
      r.target_speed[to.lane] = static_cast<float>(-kGearCorrection / h * c.bias * l.coordinates.value[axis]);
    }
    if (warm_start && !drive) r.impulse[to.lane] = c.force * h;
  });
}

void storeJointForces(const JointLane& from, const RigidState& a, float h, Joint& j) {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (AxisConstraint& c : j.axis) c.force = 0.0f;
  if (hasPointPart(j)) {
    for (int i = 0; i < 3; ++i) force[i] = from.batch.point_impulse[i][from.lane] / h;
    const Vec3 local = (a.orientation * j.frame_a).conjugate() * force;
    for (int i = 0; i < 3; ++i) j.axis[i].force = local[i];
  }
  uint32_t next = 0;
  forAxisRows(j, [&](int axis, bool drive) {
    const JointAxisRows& r = from.rows[next++];
    const float f = r.impulse[from.lane] / h;
    if (!drive) j.axis[axis].force = f;
    for (int i = 0; i < 3; ++i) {
      force[i] += f * r.linear[i][from.lane];
      if (axis >= 3) torque[i] += f * r.angular_b[i][from.lane];
    }
  });
  j.force = force;
  j.torque = torque;
}

}  // namespace pfx
