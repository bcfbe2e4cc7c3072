#include "pfx/low_level/solver/contact_setup.h"

#include <algorithm>
#include <cstring>

namespace pfx {
namespace {

void setLane(Lane (&out)[3], int lane, const Vec3& v) {
  for (int i = 0; i < 3; ++i) out[i][lane] = v[i];
}

void fillPoint(ContactPointRows& p, int lane, const ContactPoint& point) {
  setLane(p.arm_a, lane, point.local_a);
  setLane(p.arm_b, lane, point.local_b);
  p.separation[lane] = point.distance;
  p.normal_mass[lane] = 1.0f;
  setLane(p.tangent_mass, lane, point.friction_impulse);
  p.normal_impulse[lane] = point.normal_impulse;
}

bool isNew(const ContactManifold& m) {
  return std::none_of(m.points.begin(), m.points.begin() + m.num_points,
                      [](const ContactPoint& p) { return p.normal_impulse > 0.0f; });
}

}  // namespace

float frictionSpread(const ContactConstraint& c) {
  constexpr float kDisc = 2.0f / 3.0f, kPolygon = 0.6f;
  return c.round_a || c.round_b ? kDisc : kPolygon;
}

void fillContactRows(ContactRows& rows, std::span<const ContactConstraint* const> constraints,
                     uint32_t idle_body) {
  uint32_t num_points = 0;
  for (const ContactConstraint* c : constraints)
    num_points = std::max(num_points, static_cast<uint32_t>(c->manifold->num_points));
  std::memset(static_cast<void*>(&rows), 0,
              offsetof(ContactRows, points) + num_points * sizeof(ContactPointRows));
  rows.num_points = num_points;
  for (int lane = 0; lane < kRowLanes; ++lane)
    rows.body_a[lane] = rows.body_b[lane] = static_cast<int>(idle_body);

  for (int lane = 0; lane < static_cast<int>(constraints.size()); ++lane) {
    const ContactConstraint& c = *constraints[lane];
    const ContactManifold& m = *c.manifold;
    rows.body_a[lane] = static_cast<int>(c.solver_a);
    rows.body_b[lane] = static_cast<int>(c.solver_b);
    rows.writable_a |= uint32_t(c.writable_a) << lane;
    rows.writable_b |= uint32_t(c.writable_b) << lane;
    rows.has_restitution |= c.restitution > 0.0f;
    setLane(rows.normal, lane, m.normal);
    setLane(rows.tangent, lane, tangents(m.normal).t1);
    rows.turns_a[lane] = c.round_a ? 0.0f : 1.0f;
    rows.turns_b[lane] = c.round_b ? 0.0f : 1.0f;
    rows.friction[lane] = c.friction;
    rows.friction_spread[lane] = frictionSpread(c);
    rows.restitution[lane] = c.restitution;
    rows.is_new |= uint32_t(isNew(m)) << lane;
    for (int i = 0; i < m.num_points; ++i) fillPoint(rows.points[i], lane, m.points[i]);
  }
}

void fillRollingRows(RollingRows& rows, std::span<const ContactConstraint* const> constraints) {
  rows = {};
  for (size_t lane = 0; lane < constraints.size(); ++lane) {
    rows.rolling[lane] = constraints[lane]->rolling_resistance;
    rows.torsional[lane] = constraints[lane]->torsional_resistance;
  }
}

void storeContactImpulses(const ContactRows& rows, std::span<const ContactConstraint* const> constraints) {
  for (int lane = 0; lane < static_cast<int>(constraints.size()); ++lane) {
    ContactManifold& m = *constraints[lane]->manifold;
    const Vec3 t1(rows.tangent[0][lane], rows.tangent[1][lane], rows.tangent[2][lane]);
    const Vec3 t2 = m.normal.cross(t1);
    for (int i = 0; i < m.num_points; ++i) {
      const ContactPointRows& p = rows.points[i];
      m.points[i].normal_impulse = p.normal_impulse[lane];
      m.points[i].friction_impulse = p.tangent_impulse[0][lane] * t1 + p.tangent_impulse[1][lane] * t2;
    }
  }
}

}  // namespace pfx
