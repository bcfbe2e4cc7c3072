// Universal joint: one shared point, two swing axes, and no twist.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct UniversalJointParams {
  Vec3 anchor_point = Vec3::Zero();  // m, world
  Vec3 axis = Vec3::UnitX();         // world, the axis that does not twist
  Vec3 up_vec = Vec3::UnitY();       // world, the first swing axis is as near to it as possible
  float swing1_lower_angle = -0.7f;  // rad, about the first swing axis
  float swing1_upper_angle = 0.7f;
  float swing2_lower_angle = -0.7f;  // rad, about axis x first swing axis
  float swing2_upper_angle = 0.7f;
  float damping = 0.0f;  // of the swing
  float bias = 1.0f;
  JointFrame joint_frame = {};  // x: axis, y and z: swing axes
};

Joint makeUniversalJoint(const RigidState& a, const RigidState& b, const UniversalJointParams& params);

}  // namespace pfx
