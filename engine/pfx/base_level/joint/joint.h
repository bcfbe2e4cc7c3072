// One record for every kind of joint: six axis constraints between a frame in body A and a frame in body B.
//
// The first three axes are translations of anchor B along the axes of frame A, the last three rotations:
// twist about the x axis, then the two components of the swing (see joint_coordinates.h). Each axis is free,
// kept in a range, or fixed; kinds of joints differ in nothing else, so that a joint changes its kind by
// being initialised again.
#pragma once

#include <cstdint>
#include <limits>

#include "pfx/base_level/math/vector.h"

namespace pfx {

enum class JointLock : uint8_t { Free, Limit, Fixed };

enum class JointKind : uint8_t { Ball, SwingTwist, Hinge, Slider, Fixed, Universal, Distance, Gear };

inline constexpr int kNumJointAxes = 6;

// One axis. Lengths in m and forces in N for translations, angles in rad and torques in N m for rotations.
struct AxisConstraint {
  JointLock lock = JointLock::Free;
  float lower = 0.0f;    // Limit: smallest value; Fixed: the value
  float upper = 0.0f;    // Limit: largest value
  float bias = 1.0f;     // 0 .. 1, share of the position error that a step takes back
  float damping = 0.0f;  // 0 .. 1, share of the velocity along a movable axis that 1/60 s takes away
  float weight = 1.0f;   // 0 .. 1, scales the whole impulse; 0: no constraint
  float max_force = std::numeric_limits<float>::infinity();  // of a fixed axis or a limit

  float motor_speed = 0.0f;      // m/s, rad/s; of B against A
  float motor_max_force = 0.0f;  // 0: no motor

  float spring_frequency = 0.0f;  // Hz, of the two bodies on this joint; 0: no spring
  float spring_damping = 0.0f;    // damping ratio
  float spring_target = 0.0f;     // where the spring is at rest

  float force = 0.0f;  // that the axis applied to B in the last sub-step; start of the next solve
};

struct Joint {
  JointKind kind = JointKind::Ball;
  bool cone = false;  // axis 4 is the angle of the swing, whatever its direction, and axis 5 is not used
  AxisConstraint axis[kNumJointAxes];
  Vec3 anchor_a = Vec3::Zero();  // m, body axes, from the centre of mass
  Vec3 anchor_b = Vec3::Zero();
  Quat frame_a = Quat::Identity();  // joint axes in body axes
  Quat frame_b = Quat::Identity();
  float gear_ratio = 1.0f;    // Gear: turns of B for one turn of A, about their x axes, in the other sense
  float gear_angle_a = 0.0f;  // rad, Gear: turned so far, over any number of turns
  float gear_angle_b = 0.0f;
  Quat gear_zero_a = Quat::Identity();  // Gear: joint axes of A in the world where its angle is zero
  Quat gear_zero_b = Quat::Identity();

  Vec3 force = Vec3::Zero();   // N, on B at its anchor, mean of the last step, world axes
  Vec3 torque = Vec3::Zero();  // N m, on B beyond that of the force, likewise
};

// Whether anything can act along the axis.
constexpr bool isConstrained(const AxisConstraint& c) {
  if (!(c.weight > 0.0f)) return false;
  return c.lock != JointLock::Free || c.damping > 0.0f || c.motor_max_force > 0.0f ||
         c.spring_frequency > 0.0f;
}

}  // namespace pfx
