#include "pfx/low_level/solver/sequential_impulse.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfx {
namespace {

constexpr float kSlop = 0.001f;           // m, overlap that is left alone
constexpr float kSoftShare = 0.03f;       // of the speed, for overlap up to kSoftOverlap
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

// Velocity of separation to go on with. A gap may close within the step; a fast impact bounces.
float wantedSeparation(const ImpulseContactInput& in, float speed) {
  const float gap = in.distance > 0.0f ? in.distance : 0.0f;
  const bool bounces = speed < -kBounceThreshold && speed * in.time_step < -gap;
  return bounces ? std::max(-gap / in.time_step, -in.restitution * speed) : -gap / in.time_step;
}

// Velocity of separation that this step alone has besides: a share of the overlap is taken back, a gap may close.
float wantedPush(const ImpulseContactInput& in, float wanted) {
  if (in.distance > 0.0f) return -in.distance / in.time_step;
  const float soft = std::clamp(-in.distance, kSlop, kSoftOverlap) - kSlop, hard = std::max(0.0f, -in.distance - kSoftOverlap);
  return std::max(0.0f, in.separate_bias * (hard + kSoftShare * soft) / in.time_step - wanted);
}

}  // namespace

void setupImpulsePoint(const ImpulseContactInput& in, ImpulsePair pair, ImpulsePoint& point) {
  const Vec3 old_tangential = ConstMap3(point.rows[1].normal) * point.rows[1].impulse +
                              ConstMap3(point.rows[2].normal) * point.rows[2].impulse;
  Map3(point.arm_a) = in.arm_a;
  Map3(point.arm_b) = in.arm_b;
  const TangentPair t = tangents(in.normal);
  const float speed = in.velocity.dot(in.normal), mass = effectiveMass(pair, point, in.normal);
  const float wanted = wantedSeparation(in, speed);
  setRow(point.rows[0], in.normal, wanted - speed, mass);
  point.push_rhs = wantedPush(in, wanted) * mass;
  for (float& push : point.push) push = 0.0f;
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

void solvePush(ImpulsePair p, float friction, ImpulsePoint& point) {
  const ConstMap3 arm_a(point.arm_a), arm_b(point.arm_b);
  const auto velocity = [&]() -> Vec3 {
    return ConstMap3(p.a.push_v) + ConstMap3(p.a.push_w).cross(arm_a) - ConstMap3(p.b.push_v) - ConstMap3(p.b.push_w).cross(arm_b);
  };
  const auto applyPush = [&](const Vec3& impulse) {
    Map3(p.a.push_v) += p.a.inv_mass * impulse;
    Map3(p.a.push_w) += turn(p.a, arm_a.cross(impulse));
    Map3(p.b.push_v) -= p.b.inv_mass * impulse;
    Map3(p.b.push_w) -= turn(p.b, arm_b.cross(impulse));
  };
  const ImpulseRow &n = point.rows[0], &s = point.rows[1], &t = point.rows[2];
  const float push = std::max(0.0f, point.push[0] + point.push_rhs - n.inv_diag * velocity().dot(ConstMap3(n.normal)));
  applyPush((push - point.push[0]) * ConstMap3(n.normal));
  const Vec3 slip = velocity();
  float js = point.push[1] - s.inv_diag * slip.dot(ConstMap3(s.normal));
  float jt = point.push[2] - t.inv_diag * slip.dot(ConstMap3(t.normal));
  const float most = friction * (n.impulse + push), size = std::sqrt(js * js + jt * jt);
  if (size > most) js *= most / size, jt *= most / size;
  applyPush((js - point.push[1]) * ConstMap3(s.normal) + (jt - point.push[2]) * ConstMap3(t.normal));
  point.push[0] = push, point.push[1] = js, point.push[2] = jt;
}

}  // namespace pfx
