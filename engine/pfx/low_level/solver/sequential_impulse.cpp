#include "pfx/low_level/solver/sequential_impulse.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfx {
namespace {

constexpr float kSlop = 0.001f;           // m, overlap that is left alone
constexpr float kBounceThreshold = 0.5f;  // m/s, slower impacts do not bounce

using Map3 = Eigen::Map<Vec3>;
using ConstMap3 = Eigen::Map<const Vec3>;

Vec3 turn(const ImpulseBody& body, const Vec3& torque) {
  return Eigen::Map<const Mat3>(body.inv_inertia) * torque;
}

Vec3 pointVelocity(ImpulsePair p, const Vec3& arm_a, const Vec3& arm_b) {
  return ConstMap3(p.a.dv) + ConstMap3(p.a.dw).cross(arm_a) - ConstMap3(p.b.dv) - ConstMap3(p.b.dw).cross(arm_b);
}

void apply(ImpulsePair p, const ImpulsePoint& point, const Vec3& impulse) {
  Map3(p.a.dv) += p.a.inv_mass * impulse;
  Map3(p.a.dw) += turn(p.a, ConstMap3(point.arm_a).cross(impulse));
  Map3(p.b.dv) -= p.b.inv_mass * impulse;
  Map3(p.b.dw) -= turn(p.b, ConstMap3(point.arm_b).cross(impulse));
}

float effectiveMass(ImpulsePair p, const ImpulsePoint& point, const Vec3& n) {
  const Vec3 ta = ConstMap3(point.arm_a).cross(n), tb = ConstMap3(point.arm_b).cross(n);
  const float k = p.a.inv_mass + p.b.inv_mass + ta.dot(turn(p.a, ta)) + tb.dot(turn(p.b, tb));
  return k > 0.0f ? 1.0f / k : 0.0f;
}

void setRow(ImpulseRow& row, const Vec3& n, float wanted_change, float mass) {
  Map3(row.normal) = n;
  row.inv_diag = mass;
  row.rhs = wanted_change * mass;
}

// Velocity of separation to reach. A gap may close within the step; overlap is taken back by a share; a fast impact
// bounces.
float wantedSeparation(const ImpulseContactInput& in, float speed) {
  const float gap = in.distance > 0.0f ? in.distance : 0.0f;
  const float overlap = std::max(0.0f, -in.distance - kSlop);
  const float wanted = (in.separate_bias * overlap - gap) / in.time_step;
  const bool bounces = speed < -kBounceThreshold && speed * in.time_step < -gap;
  return bounces ? std::max(wanted, -in.restitution * speed) : wanted;
}

}  // namespace

void setupImpulsePoint(const ImpulseContactInput& in, ImpulsePair pair, ImpulsePoint& point) {
  const Vec3 old_tangential = ConstMap3(point.rows[1].normal) * point.rows[1].impulse +
                              ConstMap3(point.rows[2].normal) * point.rows[2].impulse;
  Map3(point.arm_a) = in.arm_a;
  Map3(point.arm_b) = in.arm_b;
  const TangentPair t = tangents(in.normal);
  const float speed = in.velocity.dot(in.normal);
  setRow(point.rows[0], in.normal, wantedSeparation(in, speed) - speed, effectiveMass(pair, point, in.normal));
  setRow(point.rows[1], t.t1, -in.velocity.dot(t.t1), effectiveMass(pair, point, t.t1));
  setRow(point.rows[2], t.t2, -in.velocity.dot(t.t2), effectiveMass(pair, point, t.t2));
  point.rows[1].impulse = old_tangential.dot(t.t1);
  point.rows[2].impulse = old_tangential.dot(t.t2);
  point.rows[0].lower = 0.0f;
  point.rows[0].upper = std::numeric_limits<float>::max();
}

void warmStart(ImpulsePair pair, const ImpulsePoint& point) {
  Vec3 impulse = Vec3::Zero();
  for (const ImpulseRow& row : point.rows) impulse += row.impulse * ConstMap3(row.normal);
  apply(pair, point, impulse);
}

void solveImpulses(ImpulsePair pair, float friction, ImpulsePoint& point) {
  ImpulseRow& n = point.rows[0];
  const Vec3 dv = pointVelocity(pair, ConstMap3(point.arm_a), ConstMap3(point.arm_b));
  const float normal = std::max(0.0f, n.impulse + n.rhs - n.inv_diag * dv.dot(ConstMap3(n.normal)));
  apply(pair, point, (normal - n.impulse) * ConstMap3(n.normal));
  n.impulse = normal;

  ImpulseRow &s = point.rows[1], &t = point.rows[2];
  const Vec3 slip = pointVelocity(pair, ConstMap3(point.arm_a), ConstMap3(point.arm_b));
  float js = s.impulse + s.rhs - s.inv_diag * slip.dot(ConstMap3(s.normal));
  float jt = t.impulse + t.rhs - t.inv_diag * slip.dot(ConstMap3(t.normal));
  const float most = friction * normal, size = std::sqrt(js * js + jt * jt);
  if (size > most) js *= most / size, jt *= most / size;
  apply(pair, point, (js - s.impulse) * ConstMap3(s.normal) + (jt - t.impulse) * ConstMap3(t.normal));
  s.impulse = js, t.impulse = jt;
}

namespace {

// Rate that the axis is to reach, and between which impulses.
struct AxisGoal {
  float rate, lower, upper;
};
AxisGoal axisGoal(const ImpulseJointInput& in) {
  const AxisConstraint& axis = in.axis;
  const float most = axis.max_force, x = static_cast<float>(in.value), h = in.time_step;
  if (axis.lock == JointLock::Fixed) return {-axis.bias * (x - axis.lower) / h, -most, most};
  if (axis.lock == JointLock::Limit) {
    // Inside the range the axis may come as near to the limit as there is way left.
    if (x > axis.upper) return {-axis.bias * (x - axis.upper) / h, -most, 0.0f};
    if (x < axis.lower) return {-axis.bias * (x - axis.lower) / h, 0.0f, most};
    if (x + in.rate * h > axis.upper) return {(axis.upper - x) / h, -most, 0.0f};
    if (x + in.rate * h < axis.lower) return {(axis.lower - x) / h, 0.0f, most};
  }
  const float damping = std::clamp(axis.damping, 0.0f, 1.0f);
  if (damping == 0.0f) return {0.0f, 0.0f, 0.0f};
  return {(1.0f - damping) * in.rate, -most, most};
}

void apply(ImpulsePair p, const ImpulseJointRow& row, float impulse) {
  const float* j = row.jacobian;
  Map3(p.a.dv) += p.a.inv_mass * impulse * ConstMap3(j);
  Map3(p.a.dw) += turn(p.a, impulse * ConstMap3(j + 3));
  Map3(p.b.dv) += p.b.inv_mass * impulse * ConstMap3(j + 6);
  Map3(p.b.dw) += turn(p.b, impulse * ConstMap3(j + 9));
}

}  // namespace

void setupImpulseJointRow(const ImpulseJointInput& in, ImpulsePair p, ImpulseJointRow& row) {
  for (int k = 0; k < 6; ++k) {
    row.jacobian[k] = static_cast<float>(in.jacobian_a[k]);
    row.jacobian[6 + k] = static_cast<float>(in.jacobian_b[k]);
  }
  const float* j = row.jacobian;
  const Vec3 wa = ConstMap3(j + 3), wb = ConstMap3(j + 9);
  const float k = p.a.inv_mass * ConstMap3(j).squaredNorm() + wa.dot(turn(p.a, wa)) +
                  p.b.inv_mass * ConstMap3(j + 6).squaredNorm() + wb.dot(turn(p.b, wb));
  const AxisGoal goal = axisGoal(in);
  row.inv_diag = k > 0.0f ? 1.0f / k : 0.0f;
  row.rhs = (goal.rate - in.rate) * row.inv_diag;
  row.lower = goal.lower, row.upper = goal.upper;
  row.weight = std::clamp(in.axis.weight, 0.0f, 1.0f);
  row.impulse = in.warm_start ? std::clamp(row.impulse, row.lower, row.upper) : 0.0f;
}

void warmStart(ImpulsePair pair, const ImpulseJointRow& row) { apply(pair, row, row.impulse); }

void solveImpulses(ImpulsePair p, ImpulseJointRow& row) {
  if (row.lower == row.upper) return;
  const float* j = row.jacobian;
  const float rate = ConstMap3(j).dot(ConstMap3(p.a.dv)) + ConstMap3(j + 3).dot(ConstMap3(p.a.dw)) +
                     ConstMap3(j + 6).dot(ConstMap3(p.b.dv)) + ConstMap3(j + 9).dot(ConstMap3(p.b.dw));
  const float change = row.weight * (row.rhs - row.inv_diag * rate);
  const float impulse = std::clamp(row.impulse + change, row.lower, row.upper);
  apply(p, row, impulse - row.impulse);
  row.impulse = impulse;
}

}  // namespace pfx
