// The fields of bodies, joints and contacts, for any archive (fields.h).
#pragma once

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/util/serialize/fields.h"

namespace pfx::serial {

template <class A>
void io(A& a, RigidState& s) {
  field(a, "position", s.position), field(a, "orientation", s.orientation),
      field(a, "linear-velocity", s.linear_velocity), field(a, "angular-velocity", s.angular_velocity);
  field(a, "body-id", s.body_id), field(a, "filter-self", s.filter_self),
      field(a, "filter-target", s.filter_target), field(a, "sleep-count", s.sleep_count);
  enumField(a, "motion-type", s.motion_type, MotionType::Trigger);
  field(a, "can-sleep", s.can_sleep), field(a, "asleep", s.asleep);
}

template <class A>
void io(A& a, RigidBody& b) {
  field(a, "mass", b.mass), field(a, "inertia", b.inertia), field(a, "restitution", b.restitution),
      field(a, "friction", b.friction), field(a, "linear-damping", b.linear_damping);
  field(a, "angular-damping", b.angular_damping), field(a, "rolling-resistance", b.rolling_resistance),
      field(a, "gravity-scale", b.gravity_scale);
}

template <class A>
void io(A& a, Inertia& i) {
  field(a, "body", i.body), field(a, "inverse-body", i.inverse_body), field(a, "spherical", i.spherical);
}

template <class A>
void io(A& a, AxisConstraint& c) {
  enumField(a, "lock", c.lock, JointLock::Fixed);
  field(a, "lower", c.lower), field(a, "upper", c.upper), field(a, "bias", c.bias),
      field(a, "damping", c.damping), field(a, "weight", c.weight), field(a, "max-force", c.max_force);
  field(a, "motor-speed", c.motor_speed), field(a, "motor-max-force", c.motor_max_force),
      field(a, "spring-frequency", c.spring_frequency), field(a, "spring-damping", c.spring_damping);
  field(a, "spring-target", c.spring_target), field(a, "force", c.force);
}

template <class A>
void io(A& a, Joint& j) {
  enumField(a, "kind", j.kind, JointKind::Gear);
  field(a, "cone", j.cone), field(a, "axis", j.axis), field(a, "anchor-a", j.anchor_a),
      field(a, "anchor-b", j.anchor_b), field(a, "frame-a", j.frame_a), field(a, "frame-b", j.frame_b);
  field(a, "gear-ratio", j.gear_ratio), field(a, "gear-angle-a", j.gear_angle_a),
      field(a, "gear-angle-b", j.gear_angle_b), field(a, "gear-zero-a", j.gear_zero_a),
      field(a, "gear-zero-b", j.gear_zero_b);
  field(a, "force", j.force), field(a, "torque", j.torque);
}

template <class A>
void io(A& a, ContactPoint& p) {
  field(a, "local-a", p.local_a), field(a, "local-b", p.local_b), field(a, "distance", p.distance),
      field(a, "feature", p.feature), field(a, "triangle", p.triangle),
      field(a, "barycentric", p.barycentric);
  field(a, "normal-impulse", p.normal_impulse), field(a, "friction-impulse", p.friction_impulse);
}

template <class A>
void io(A& a, ContactManifold& m) {
  field(a, "normal", m.normal), field(a, "local-normal", m.local_normal),
      field(a, "num-points", m.num_points);
  if constexpr (A::kReads) {
    const bool fits = m.num_points >= 0 && m.num_points <= kMaxContactPoints;
    a.require(fits, "a manifold has too many points");
    if (!fits) m.num_points = 0;
  }
  for (int i = 0; i < m.num_points; ++i) field(a, "point", m.points[static_cast<size_t>(i)]);
}

}  // namespace pfx::serial
