// Snapshots: the bytes of bodies, joints and contacts.
#pragma once

#include "pfx/high_level/world/snapshot_shapes.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::snapshot_format {

template <class A>
void io(A& a, RigidState& s) {
  io(a, s.position), io(a, s.orientation), io(a, s.linear_velocity), io(a, s.angular_velocity);
  io(a, s.body_id), io(a, s.filter_self), io(a, s.filter_target), io(a, s.sleep_count);
  ioEnum(a, s.motion_type, MotionType::Trigger);
  io(a, s.can_sleep), io(a, s.asleep);
}

template <class A>
void io(A& a, RigidBody& b) {
  io(a, b.mass), io(a, b.inertia), io(a, b.restitution), io(a, b.friction), io(a, b.linear_damping);
  io(a, b.angular_damping), io(a, b.rolling_resistance), io(a, b.gravity_scale);
}

template <class A>
void io(A& a, Inertia& i) {
  io(a, i.body), io(a, i.inverse_body), io(a, i.spherical);
}

template <class A>
void io(A& a, AxisConstraint& c) {
  ioEnum(a, c.lock, JointLock::Fixed);
  io(a, c.lower), io(a, c.upper), io(a, c.bias), io(a, c.damping), io(a, c.weight), io(a, c.max_force);
  io(a, c.motor_speed), io(a, c.motor_max_force), io(a, c.spring_frequency), io(a, c.spring_damping);
  io(a, c.spring_target), io(a, c.force);
}

template <class A>
void io(A& a, Joint& j) {
  ioEnum(a, j.kind, JointKind::Gear);
  io(a, j.cone), io(a, j.axis), io(a, j.anchor_a), io(a, j.anchor_b), io(a, j.frame_a), io(a, j.frame_b);
  io(a, j.gear_ratio), io(a, j.gear_angle_a), io(a, j.gear_angle_b), io(a, j.gear_zero_a), io(a, j.gear_zero_b);
  io(a, j.force), io(a, j.torque);
}

template <class A>
void io(A& a, JointLink& l) {
  io(a, l.body_a), io(a, l.body_b), io(a, l.exists), io(a, l.bodies_collide);
}

template <class A>
void io(A& a, ContactReach& r) {
  io(a, r.resting), io(a, r.travel);
}

template <class A>
void io(A& a, BodyPose& k) {
  io(a, k.body), io(a, k.pose);
}

template <class A>
void io(A& a, JointId& id) {
  io(a, id.index), io(a, id.generation);
}

template <class A>
void io(A& a, ContactPoint& p) {
  io(a, p.local_a), io(a, p.local_b), io(a, p.distance), io(a, p.feature), io(a, p.triangle), io(a, p.barycentric);
  io(a, p.normal_impulse), io(a, p.friction_impulse);
}

template <class A>
void io(A& a, ContactManifold& m) {
  io(a, m.normal), io(a, m.local_normal), io(a, m.num_points);
  if constexpr (A::kReads)
    a.require(m.num_points >= 0 && m.num_points <= kMaxContactPoints, "a manifold has too many points");
  for (int i = 0; i < m.num_points; ++i) io(a, m.points[static_cast<size_t>(i)]);
}

template <class A>
void io(A& a, PairCache& c) {
  io(a, c.b_in_a), io(a, c.axis), io(a, c.separation), io(a, c.radius_b), io(a, c.hint);
}

// A pair with its contact. The ids of contacts are given anew; nothing depends on them.
template <class A>
void ioPairs(A& a, std::vector<Pair>& pairs, ContactStore& contacts) {
  constexpr size_t kMostManifolds = 1u << 15;  // of one pair
  std::vector<ContactManifold> manifolds;
  ioList(a, pairs, [&](A& archive, Pair& p) {
    io(archive, p.body_a), io(archive, p.body_b), io(archive, p.flags);
    if constexpr (A::kReads) {
      p.contact_id = contacts.add();
    } else {
      const auto found = contacts.manifolds(p.contact_id);
      manifolds.assign(found.begin(), found.end());
    }
    io(archive, manifolds);
    if constexpr (A::kReads) {
      archive.require(manifolds.size() <= kMostManifolds, "a pair has too many manifolds");
      contacts.assign(p.contact_id, manifolds);
    }
    Contact& c = contacts[p.contact_id];
    io(archive, c.rolls), io(archive, c.reported_touching), io(archive, c.cache), io(archive, c.relative);
  });
}

}  // namespace pfx::snapshot_format
