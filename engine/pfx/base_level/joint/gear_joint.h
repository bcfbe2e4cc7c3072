// Gear: the rotations of two bodies about their own axes keep a ratio, from the start on.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct GearJointParams {
  Vec3 axis_a = Vec3::UnitX();  // world
  Vec3 axis_b = Vec3::UnitX();  // world
  float ratio = 1.0f;           // turns of B, against the sense of A, for one turn of A
};

Joint makeGearJoint(const RigidState& a, const RigidState& b, const GearJointParams& params);

}  // namespace pfx
