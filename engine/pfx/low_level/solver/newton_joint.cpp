#include "pfx/low_level/solver/newton_joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfx {
namespace {

// 1 / k in units of the inverse effective mass of the row: of equations, and of rows that come to their
// bounds, which would come and go one by one if they were as stiff.
constexpr double kGive = 1e-5, kBoundedGive = 1e-3;

// give: share of the inverse effective mass that the row gives way by, besides its compliance.
NewtonRow makeRow(const DirectJoint& j, int axis_row, double give, double compliance) {
  NewtonRow r = {};
  r.axis_row = axis_row;
  double inverse_mass = 0.0;
  for (int i = 0; i < 6; ++i) {
    r.jacobian.a[i] = j.jacobian[0][axis_row][i], r.jacobian.b[i] = j.jacobian[1][axis_row][i];
    inverse_mass +=
        r.jacobian.a[i] * j.response[0][axis_row][i] + r.jacobian.b[i] * j.response[1][axis_row][i];
  }
  const double way = give * inverse_mass + compliance;
  r.stiffness = way > 0.0 ? 1.0 / way : 0.0;
  r.curvature = -1.0;
  return r;
}

// Motor, spring or damper: speed = drive_speed - compliance * impulse, up to its strength.
NewtonRow makeDrive(const DirectJoint& j, int k) {
  const DirectRow& d = j.row[k];
  NewtonRow r = makeRow(j, k, kBoundedGive, d.drive_compliance);
  r.bias = -d.drive_speed;
  r.most = d.drive_bound, r.least = -d.drive_bound;
  r.impulse = std::clamp(d.impulse, r.least, r.most);
  if (d.drive_compliance == 0.0) r.base = r.impulse;
  return r;
}

// m/s at most that an error of the position is taken back with. What another solver let stretch would throw
// what it holds.
constexpr double kMostPushSpeed = 0.65;

// Speed that takes back the error of an equation or a passed limit, or that a limit which is not reached
// allows.
double biasOf(const DirectRow& d, double length, double error, bool passed, double h, bool push) {
  if (!passed) return error / h;
  const double most = kMostPushSpeed / (d.axis < 3 ? 1.0 : length);
  return push ? std::clamp((1.0 - d.keep) * error / h, -most, most) : 0.0;
}

NewtonRow makeHold(const DirectJoint& j, int k, double h, bool push) {
  const DirectRow& d = j.row[k];
  const AxisConstraint& c = j.joint->axis[d.axis];
  const double lower = c.lower, upper = c.upper;
  NewtonRow r = makeRow(j, k, d.softness + (d.state == RowState::Fixed ? kGive : kBoundedGive), 0.0);
  r.least = -d.bound, r.most = d.bound;
  if (d.state == RowState::Fixed) {
    r.bias = biasOf(d, j.length, d.value - lower, true, h, push);
  } else if (d.value - lower < upper - d.value) {
    r.bias = biasOf(d, j.length, d.value - lower, d.value < lower, h, push);
    r.least = 0.0;
  } else {
    r.bias = biasOf(d, j.length, d.value - upper, d.value > upper, h, push);
    r.most = 0.0;
  }
  return r;
}

double impulseAt(const NewtonRow& r, double speed) {
  return std::clamp(r.base - r.stiffness * (speed + r.bias), r.least, r.most);
}

double along(const NewtonJacobian& m, const double* va, const double* vb) {
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) sum += m.a[i] * va[i] + m.b[i] * vb[i];
  return sum;
}

}  // namespace

NewtonJoint makeNewtonJoint(const JointConstraint& constraint, const uint32_t (&body)[2]) {
  NewtonJoint n = {};
  DirectJoint& j = n.joint;
  j.joint = constraint.joint;
  j.body[0] = body[0], j.body[1] = body[1];
  j.moves[0] = constraint.writable_a, j.moves[1] = constraint.writable_b;
  chooseRows(j);
  return n;
}

void begin(NewtonJoint& n, std::span<const DirectBody> bodies, double h, int substeps) {
  beginRows(n.joint, bodies, substeps, true);
  for (int k = 0; k < n.joint.num_rows; ++k) {
    DirectRow& r = n.joint.row[k];
    r.impulse = h * static_cast<double>(n.joint.joint->axis[r.axis].force);
  }
}

double strengthOf(const NewtonJoint& n) {
  double sum = 0.0;
  for (int axis = 0; axis < kNumJointAxes; ++axis) {
    const double most = n.joint.joint->axis[axis].motor_max_force;
    if (std::isfinite(most)) sum += most / (axis < 3 ? 1.0 : n.joint.length);
  }
  return sum;
}

void linearize(NewtonJoint& n, std::span<const DirectBody> bodies, double h, bool push) {
  DirectJoint& j = n.joint;
  linearizeRows(j, bodies, {h, 1.0, false, false});
  n.num_rows = 0;
  for (int k = 0; k < j.num_rows; ++k) {
    DirectRow& d = j.row[k];
    double left = d.impulse;
    if (d.has_drive) {
      const NewtonRow& drive = n.row[n.num_rows++] = makeDrive(j, k);
      left -= drive.impulse;
    }
    if (j.joint->axis[d.axis].lock == JointLock::Free) continue;
    NewtonRow& hold = n.row[n.num_rows++] = makeHold(j, k, h, push);
    hold.impulse = std::clamp(left, hold.least, hold.most);
    if (d.softness == 0.0 && (d.state == RowState::Fixed || !push)) hold.base = hold.impulse;
  }
}

void evaluate(NewtonJoint& n, const double* va, const double* vb) {
  for (int k = 0; k < n.num_rows; ++k) {
    NewtonRow& r = n.row[k];
    r.speed = along(r.jacobian, va, vb);
    r.impulse = impulseAt(r, r.speed);
  }
}

void setChange(NewtonJoint& n, const double* da, const double* db) {
  for (int k = 0; k < n.num_rows; ++k) n.row[k].change = along(n.row[k].jacobian, da, db);
}

double slopeAt(const NewtonJoint& n, double step) {
  double sum = 0.0;
  for (int k = 0; k < n.num_rows; ++k) {
    const NewtonRow& r = n.row[k];
    sum -= impulseAt(r, r.speed + step * r.change) * r.change;
  }
  return sum;
}

bool setCurvature(NewtonJoint& n) {
  bool changed = false;
  for (int k = 0; k < n.num_rows; ++k) {
    NewtonRow& r = n.row[k];
    const double now = r.impulse > r.least && r.impulse < r.most ? r.stiffness : 0.0;
    changed |= now != r.curvature;
    r.curvature = now;
  }
  return changed;
}

void addCurvature(const NewtonJoint& n, const NewtonBlocks& blocks) {
  for (int k = 0; k < n.num_rows; ++k)
    if (n.row[k].curvature > 0.0) addRow(n.a_is_row, blocks, n.row[k].curvature, n.row[k].jacobian);
}

void addImpulses(const NewtonJoint& n, double sign, double* a, double* b) {
  for (int k = 0; k < n.num_rows; ++k) {
    const NewtonRow& r = n.row[k];
    for (int i = 0; i < 6; ++i) {
      a[i] += sign * r.impulse * r.jacobian.a[i];
      b[i] += sign * r.impulse * r.jacobian.b[i];
    }
  }
}

void rememberForces(NewtonJoint& n, double h) {
  DirectJoint& j = n.joint;
  for (int k = 0; k < j.num_rows; ++k) j.row[k].impulse = 0.0;
  for (int k = 0; k < n.num_rows; ++k) j.row[n.row[k].axis_row].impulse += n.row[k].impulse;
  for (int k = 0; k < j.num_rows; ++k)
    j.joint->axis[j.row[k].axis].force = static_cast<float>(j.row[k].impulse / h);
}

void forget(NewtonJoint& n) {
  for (AxisConstraint& c : n.joint.joint->axis) c.force = 0.0f;
}

}  // namespace pfx
