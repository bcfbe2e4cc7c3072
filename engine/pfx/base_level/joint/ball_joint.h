// Ball joint: one shared point, free rotation.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct BallJointParams {
  Vec3 anchor_point = Vec3::Zero();  // m, world
  float damping = 0.0f;              // of the rotation, see AxisConstraint
  float bias = 1.0f;
};

Joint makeBallJoint(const RigidState& a, const RigidState& b, const BallJointParams& params);

}  // namespace pfx
