// Swing-twist joint: one shared point, a cone for the swing and a range for the twist.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct SwingTwistJointParams {
  Vec3 anchor_point = Vec3::Zero();               // m, world
  Vec3 twist_axis = Vec3::UnitX();                // world
  float twist_lower_angle = -0.2f * 3.14159265f;  // rad
  float twist_upper_angle = 0.2f * 3.14159265f;
  float swing_lower_angle = 0.0f;  // rad, of the twist axis of B against that of A
  float swing_upper_angle = 0.25f * 3.14159265f;
  float damping = 0.0f;  // of the rotation
  float bias = 1.0f;
  JointFrame joint_frame = {};  // x: twist axis
};

Joint makeSwingTwistJoint(const RigidState& a, const RigidState& b, const SwingTwistJointParams& params);

}  // namespace pfx
