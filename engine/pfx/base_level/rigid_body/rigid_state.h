// What changes in every step: pose, velocity, and how the body takes part.
//
// State, body and collidable of one rigid body share one index in three arrays, so that each stage reads only what
// it needs: proxies need state + collidable, integration needs state + body.
#pragma once

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/rigid_body/motion_type.h"

namespace pfx {

struct RigidState {
  Vec3 position = Vec3::Zero();          // m, centre of mass in the world
  Quat orientation = Quat::Identity();   // unit, body to world
  Vec3 linear_velocity = Vec3::Zero();   // m/s
  Vec3 angular_velocity = Vec3::Zero();  // rad/s, world axes
  uint32_t body_id = 0;                  // index shared by state, body and collidable
  uint32_t filter_self = 0xffffffffu;    // a pair survives iff (a.self & b.target) && (b.self & a.target)
  uint32_t filter_target = 0xffffffffu;
  uint32_t sleep_count = 0;              // steps spent below the sleep velocity
  MotionType motion_type = MotionType::Active;
  bool can_sleep = true;
  bool asleep = false;

  Transform pose() const { return {position, orientation}; }
};

// Whether the body may be somewhere else after the step: a dynamic one that is awake, or a scripted one with a velocity.
inline bool moves(const RigidState& s) {
  if (isDynamic(s.motion_type)) return !s.asleep;
  return s.motion_type != MotionType::Fixed && !(s.linear_velocity.isZero(0.0f) && s.angular_velocity.isZero(0.0f));
}

constexpr bool filtersMatch(uint32_t self_a, uint32_t target_a, uint32_t self_b, uint32_t target_b) {
  return (self_a & target_b) != 0 && (self_b & target_a) != 0;
}

}  // namespace pfx
