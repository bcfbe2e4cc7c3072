// Fixed joint: two bodies as one.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct FixedJointParams {
  Vec3 anchor_point = Vec3::Zero();  // m, world
  float bias = 1.0f;
  JointFrame joint_frame = {};
};

Joint makeFixedJoint(const RigidState& a, const RigidState& b, const FixedJointParams& params);

}  // namespace pfx
