// Hinge: one shared point and one shared axis, with a range for the angle.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct HingeJointParams {
  Vec3 anchor_point = Vec3::Zero();  // m, world
  Vec3 axis = Vec3::UnitX();         // world
  float lower_angle = 1.0f;          // rad; lower above upper: no limit
  float upper_angle = -1.0f;
  float damping = 0.0f;  // of the rotation about the axis
  float bias = 1.0f;
  JointFrame joint_frame = {};  // x: axis
};

Joint makeHingeJoint(const RigidState& a, const RigidState& b, const HingeJointParams& params);

}  // namespace pfx
