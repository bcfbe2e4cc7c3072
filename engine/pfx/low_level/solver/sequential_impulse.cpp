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

}  // namespace pfx
