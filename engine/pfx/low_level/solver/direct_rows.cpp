#include "pfx/low_level/solver/direct_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/base_level/joint/gear_angles.h"
#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

constexpr double kTolerance = 2e-8;      // of a coordinate, in units of `length` or rad
constexpr double kShareOfSize = 0.1;     // `length` of a joint is at least this share of the radius of gyration
constexpr double kMostTurn = 1.0;        // rad a sub-step, that is measured at the predicted pose
constexpr double kReferenceRate = 60.0;  // 1/s: damping is given as a share a sixtieth of a second

double rowTolerance(const DirectJoint& j, const DirectRow& r) {
  return kTolerance * (r.axis < 3 ? j.length : 1.0);
}

const AxisConstraint& axisOf(const DirectJoint& j, const DirectRow& r) { return j.joint->axis[r.axis]; }

bool isFixed(const AxisConstraint& c) {
  return c.lock == JointLock::Fixed || (c.lock == JointLock::Limit && c.lower == c.upper);
}

bool hasDrive(const AxisConstraint& c) {
  return !isFixed(c) && (c.damping > 0.0f || c.motor_max_force > 0.0f || c.spring_frequency > 0.0f);
}

RowState restState(const DirectRow& r) { return r.has_drive ? RowState::Drive : RowState::Off; }

// Mobility along each row that has a spring or a damper: that of the axis alone less what the fixed rows take
// away, by elimination of the fixed rows from the block of the joint.
void findMobilities(DirectJoint& j) {
  const int n = j.num_rows;
  double m[kNumJointAxes][kNumJointAxes];
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      m[i][k] = 0.0;
      for (int side = 0; side < 2; ++side)
        for (int q = 0; q < 6; ++q) m[i][k] += j.jacobian[side][i][q] * j.response[side][k][q];
    }
  }
  for (int f = 0; f < n; ++f) {
    if (j.row[f].state != RowState::Fixed || m[f][f] <= 0.0) continue;
    for (int i = 0; i < n; ++i) {
      if (i == f) continue;
      const double share = m[i][f] / m[f][f];
      for (int k = 0; k < n; ++k) m[i][k] -= share * m[f][k];
    }
  }
  for (int i = 0; i < n; ++i) j.row[i].mobility = std::max(m[i][i], 1e-30);
}

void findSpring(const AxisConstraint& c, DirectRow& r) {
  const double damping = std::min(static_cast<double>(c.damping), 1.0);
  r.damping_rate =
      damping < 1.0 ? -kReferenceRate * log(1.0 - damping) : std::numeric_limits<double>::infinity();
  r.stiffness = r.damper = 0.0;
  if (c.spring_frequency <= 0.0f) return;
  const double w = 2.0 * kPiDouble * c.spring_frequency;
  r.stiffness = w * w / r.mobility;
  r.damper = (2.0 * c.spring_damping * w + std::min(r.damping_rate, 1e6)) / r.mobility;
}

// A spring over a leapfrog sub-step: impulse = -k (x + beta h^2 a) - c (mean speed), the Newmark family; beta
// = 1/12 has an error of fourth order, 1/4 is stable for any stiffness. Source: N. Newmark, A Method of
// Computation for Structural Dynamics, 1959; T. Hughes, The Finite Element Method, 2000, section 9.1.
// Otherwise implicit.
void setSpring(DirectRow& r, double displacement, double speed, const DirectSubstep& s) {
  const double kick_time = s.part * s.h;
  double factor, wanted;
  if (s.leapfrog) {
    const bool slow = r.stiffness * r.mobility * s.h * s.h < 1.0;
    const double inertia = (slow ? 1.0 / 12.0 : 0.25) * s.h * s.h * r.stiffness,
                 half = 0.5 * kick_time * r.damper;
    factor = half + inertia;
    wanted = (inertia - half) * speed - kick_time * r.stiffness * displacement;
  } else {
    factor = kick_time * (r.damper + s.h * r.stiffness);
    wanted = -kick_time * r.stiffness * displacement;
  }
  r.drive_compliance = 1.0 / factor;
  r.drive_speed = wanted / factor;
}

void setDrive(const AxisConstraint& c, DirectRow& r, double speed, const DirectSubstep& s) {
  const double kick_time = s.part * s.h;
  r.drive_bound =
      c.motor_max_force > 0.0f ? c.motor_max_force * kick_time : std::numeric_limits<double>::infinity();
  if (r.stiffness > 0.0) return setSpring(r, r.value - c.spring_target, speed, s);
  if (c.motor_max_force > 0.0f) {
    r.drive_compliance = 0.0;
    r.drive_speed = c.motor_speed;
    return;
  }
  const double left = std::isinf(r.damping_rate) ? 0.0 : exp(-r.damping_rate * kick_time);
  r.drive_compliance = r.mobility * left / (1.0 - left);
  r.drive_speed = 0.0;
}

void setGoal(const AxisConstraint& c, DirectRow& r) {
  switch (r.state) {
    case RowState::Upper:
      r.goal = c.upper + r.keep * std::max(r.value - c.upper, 0.0);
      break;
    case RowState::Lower:
      r.goal = c.lower + r.keep * std::min(r.value - c.lower, 0.0);
      break;
    default:
      r.goal = c.lower + r.keep * (r.value - c.lower);
  }
}

void enter(DirectJoint& j, DirectRow& r, RowState state) {
  r.state = state;
  r.clamped = 0;
  r.held = state != RowState::Off;
  if (state != RowState::Off && state != RowState::Drive) setGoal(axisOf(j, r), r);
}

void setImpulse(DirectJoint& j, int row, double impulse, std::span<DirectBody> bodies) {
  applyRow(j, row, impulse - j.row[row].impulse, bodies);
  j.row[row].impulse = impulse;
}

// The least impulse that a limit needs to stay closed: less, and the motor would open it.
double openingImpulse(const AxisConstraint& c, const DirectRow& r) {
  if (!r.has_drive || c.motor_max_force <= 0.0f || c.spring_frequency > 0.0f) return 0.0;
  const bool opens = r.state == RowState::Lower ? c.motor_speed > 0.0f : c.motor_speed < 0.0f;
  return opens ? r.drive_bound : -r.drive_bound;
}

bool passesLimit(DirectJoint& j, int i, std::span<DirectBody> bodies, bool velocity_only) {
  DirectRow& r = j.row[i];
  const AxisConstraint& c = axisOf(j, r);
  if (c.lock != JointLock::Limit) return false;
  const double tolerance = rowTolerance(j, r);
  bool below, above;
  if (velocity_only) {
    below = r.value < c.lower + tolerance && rowSpeed(j, i, bodies) < -tolerance;
    above = r.value > c.upper - tolerance && rowSpeed(j, i, bodies) > tolerance;
  } else {
    const double lower = c.lower + r.keep * std::min(r.value - c.lower, 0.0);
    const double upper = c.upper + r.keep * std::max(r.value - c.upper, 0.0);
    below = r.next<lower - tolerance, above = r.next> upper + tolerance;
  }
  if (below) enter(j, r, RowState::Lower);
  if (above) enter(j, r, RowState::Upper);
  return below || above;
}

bool clampToBound(DirectJoint& j, int i, std::span<DirectBody> bodies, double bound) {
  DirectRow& r = j.row[i];
  if (std::abs(r.impulse) <= bound) return false;
  r.clamped = r.impulse > 0.0 ? 1 : -1;
  r.held = false;
  setImpulse(j, i, r.clamped * bound, bodies);
  return true;
}

bool leaveState(DirectJoint& j, int i, std::span<DirectBody> bodies) {
  DirectRow& r = j.row[i];
  const AxisConstraint& c = axisOf(j, r);
  const bool lower = r.state == RowState::Lower, upper = r.state == RowState::Upper;
  if (lower || upper) {
    const double push = lower ? r.impulse : -r.impulse, opening = openingImpulse(c, r);
    if (push < opening - 1e-12 * std::abs(opening)) {
      enter(j, r, restState(r));
      if (r.state == RowState::Off) setImpulse(j, i, 0.0, bodies);
      return true;
    }
  }
  return clampToBound(j, i, bodies, r.state == RowState::Drive ? r.drive_bound : r.bound);
}

}  // namespace

void chooseRows(DirectJoint& j) {
  j.num_rows = 0;
  for (int axis = 0; axis < kNumJointAxes; ++axis) {
    const AxisConstraint& c = j.joint->axis[axis];
    if (!isConstrained(c)) continue;
    DirectRow& r = j.row[j.num_rows++];
    r = {};
    r.axis = static_cast<uint8_t>(axis);
    r.has_drive = hasDrive(c);
    enter(j, r, isFixed(c) ? RowState::Fixed : restState(r));
  }
}

void beginRows(DirectJoint& j, std::span<const DirectBody> bodies, int substeps, bool warm_start) {
  // The arm of a fixed body may be as long as the world is wide, and says nothing about the joint; that of a wheel on
  // its axle is nothing.
  const Vec3* const anchor[2] = {&j.joint->anchor_a, &j.joint->anchor_b};
  double arms = 0.0, size = 0.0;
  for (int side = 0; side < 2; ++side) {
    const DirectBody& b = bodies[j.body[side]];
    if (!j.moves[side]) continue;
    arms += static_cast<double>(anchor[side]->norm());
    size = std::max(size, std::sqrt(b.body_inertia.trace() / 3.0 * b.inv_mass));
  }
  j.length = std::max({arms, kShareOfSize * size, 1e-6});
  j.impulse_sum = j.torque_sum = Vec3d::Zero();
  j.turned = j.expected = {j.joint->gear_angle_a, j.joint->gear_angle_b};
  for (int i = 0; i < j.num_rows; ++i) {
    DirectRow& r = j.row[i];
    AxisConstraint& c = j.joint->axis[r.axis];
    const double bias = std::clamp(static_cast<double>(c.bias), 0.0, 1.0);
    r.keep = bias < 1.0 ? pow(1.0 - bias, 1.0 / substeps) : 0.0;
    const double weight = std::clamp(static_cast<double>(c.weight), 1e-6, 1.0);
    r.softness = (1.0 - weight) / weight;
    if (!warm_start) c.force = 0.0f;
  }
}

void linearizeRows(DirectJoint& j, std::span<const DirectBody> bodies, const DirectSubstep& s) {
  const JointLinearization l = linearizeJoint(*j.joint, bodies[j.body[0]].pose, bodies[j.body[1]].pose);
  const bool gear = j.joint->kind == JointKind::Gear;
  if (gear) j.turned = gearAnglesNear(*j.joint, bodies[j.body[0]].pose, bodies[j.body[1]].pose, j.expected);
  bool drives = false;
  for (int i = 0; i < j.num_rows; ++i) {
    DirectRow& r = j.row[i];
    r.value = gear ? gearCoordinate(*j.joint, j.turned) : l.coordinates.value[r.axis];
    std::copy_n(l.jacobian.a[r.axis], 6, j.jacobian[0][i]);
    std::copy_n(l.jacobian.b[r.axis], 6, j.jacobian[1][i]);
    drives |= r.has_drive;
    const double bound = static_cast<double>(axisOf(j, r).max_force);
    r.bound = std::isinf(bound) ? bound : bound * s.part * s.h;
    setGoal(axisOf(j, r), r);
  }
  updateResponses(j, bodies);
  if (!drives) return;
  findMobilities(j);
  for (int i = 0; i < j.num_rows; ++i) {
    DirectRow& r = j.row[i];
    if (!r.has_drive) continue;
    findSpring(axisOf(j, r), r);
    setDrive(axisOf(j, r), r, rowSpeed(j, i, bodies), s);
  }
}

void updateResponses(DirectJoint& j, std::span<const DirectBody> bodies) {
  for (int side = 0; side < 2; ++side) {
    const DirectBody& b = bodies[j.body[side]];
    const double inv_mass = j.moves[side] ? b.inv_mass : 0.0;
    const Mat3d inverse = j.moves[side] ? b.inverse : Mat3d(Mat3d::Zero());
    for (int i = 0; i < j.num_rows; ++i) {
      const double* from = j.jacobian[side][i];
      double* to = j.response[side][i];
      for (int q = 0; q < 3; ++q) {
        to[q] = inv_mass * from[q];
        to[3 + q] = inverse(q, 0) * from[3] + inverse(q, 1) * from[4] + inverse(q, 2) * from[5];
      }
    }
  }
}

double rowSpeed(const DirectJoint& j, int row, std::span<const DirectBody> bodies) {
  double speed = 0.0;
  for (int side = 0; side < 2; ++side) {
    const DirectBody& b = bodies[j.body[side]];
    const double* m = j.jacobian[side][row];
    speed +=
        (m[0] * b.v[0] + m[1] * b.v[1] + m[2] * b.v[2]) + (m[3] * b.w[0] + m[4] * b.w[1] + m[5] * b.w[2]);
  }
  return speed;
}

void applyRow(const DirectJoint& j, int row, double impulse, std::span<DirectBody> bodies) {
  for (int side = 0; side < 2; ++side) {
    if (!j.moves[side]) continue;
    DirectBody& b = bodies[j.body[side]];
    const double* m = j.response[side][row];
    for (int q = 0; q < 3; ++q) b.v[q] += impulse * m[q], b.w[q] += impulse * m[3 + q];
  }
}

void measureNext(DirectJoint& j, std::span<const DirectBody> bodies, double h) {
  const DirectBody &a = bodies[j.body[0]], &b = bodies[j.body[1]];
  if (j.joint->kind == JointKind::Gear) {
    const GearAngles rate = gearRates(*j.joint, a.pose, a.w, b.pose, b.w);
    j.expected = gearAnglesNear(*j.joint, a.next, b.next, {j.turned.a + h * rate.a, j.turned.b + h * rate.b});
    for (int i = 0; i < j.num_rows; ++i) j.row[i].next = gearCoordinate(*j.joint, j.expected);
    return;
  }
  const JointCoordinates c = measureJoint(*j.joint, a.next, b.next);
  for (int i = 0; i < j.num_rows; ++i) {
    // An angle that has come round says nothing.
    const double way = j.row[i].axis < 3 ? 0.0 : h * rowSpeed(j, i, bodies);
    j.row[i].next = std::abs(way) > kMostTurn ? j.row[i].value + way : c.value[j.row[i].axis];
  }
}

bool updateRows(DirectJoint& j, std::span<DirectBody> bodies, bool velocity_only, bool first) {
  bool changed = false;
  for (int i = 0; i < j.num_rows; ++i) {
    DirectRow& r = j.row[i];
    if (r.state == RowState::Off || r.state == RowState::Drive) {
      if (passesLimit(j, i, bodies, velocity_only)) {
        changed = true;
        continue;
      }
    }
    if (first) continue;
    if (r.held) {
      changed |= leaveState(j, i, bodies);
    } else if (r.clamped != 0) {
      const double lacking = r.state == RowState::Drive ? r.drive_speed - rowSpeed(j, i, bodies)
                             : velocity_only            ? -rowSpeed(j, i, bodies)
                                                        : r.goal - r.next;
      if (lacking * r.clamped < -rowTolerance(j, r)) {
        r.held = true, r.clamped = 0;
        changed = true;
      }
    }
  }
  return changed;
}

RowResidual rowResidual(const DirectJoint& j, int row, std::span<const DirectBody> bodies,
                        const DirectSubstep& s, bool velocity_only) {
  const DirectRow& r = j.row[row];
  const double tolerance = rowTolerance(j, r) / s.h;
  if (r.state == RowState::Drive)
    return {r.drive_speed - rowSpeed(j, row, bodies) - r.drive_compliance * r.impulse, tolerance};
  const double give = r.softness * r.diagonal * r.impulse;
  if (velocity_only) return {-rowSpeed(j, row, bodies) - give, tolerance};
  const double reached = s.linear ? r.value + s.h * rowSpeed(j, row, bodies) : r.next;
  return {-(reached - r.goal) / s.h - give, tolerance};
}

// sym(F r^T) - (r . F) 1 at lever r.
void addStiffness(const DirectJoint& j, std::span<DirectBody> bodies) {
  for (int side = 0; side < 2; ++side) {
    if (!j.moves[side]) continue;
    DirectBody& b = bodies[j.body[side]];
    Vec3d force = Vec3d::Zero();
    for (int i = 0; i < j.num_rows; ++i) {
      const double* m = j.jacobian[side][i];
      force += static_cast<double>(j.joint->axis[j.row[i].axis].force) * Vec3d(m[0], m[1], m[2]);
    }
    const Vec3d arm = b.pose.orientation * (side == 0 ? j.joint->anchor_a : j.joint->anchor_b).cast<double>();
    const Mat3d product = force * arm.transpose();
    b.stiffness += 0.5 * (product + product.transpose());
    b.stiffness.diagonal().array() -= arm.dot(force);
  }
}

void sumImpulses(DirectJoint& j, std::span<const DirectBody> bodies) {
  const Vec3d arm = bodies[j.body[1]].pose.orientation * j.joint->anchor_b.cast<double>();
  for (int k = 0; k < j.num_rows; ++k) {
    const double* m = j.jacobian[1][k];
    const Vec3d force(m[0], m[1], m[2]), torque(m[3], m[4], m[5]);
    j.impulse_sum += j.row[k].impulse * force;
    j.torque_sum += j.row[k].impulse * (torque - arm.cross(force));
  }
}

void reportForces(const DirectJoint& j, double dt) {
  j.joint->force = (j.impulse_sum / dt).cast<float>();
  j.joint->torque = (j.torque_sum / dt).cast<float>();
  if (j.joint->kind != JointKind::Gear) return;
  j.joint->gear_angle_a = static_cast<float>(j.turned.a);
  j.joint->gear_angle_b = static_cast<float>(j.turned.b);
}

}  // namespace pfx
