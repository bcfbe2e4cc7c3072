// Slider: motion along one axis, with a range for the distance, and no rotation.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct SliderJointParams {
  Vec3 anchor_point = Vec3::Zero();  // m, world
  Vec3 direction = Vec3::UnitX();    // world
  float lower_distance = 1.0f;       // m; lower above upper: no limit
  float upper_distance = -1.0f;
  float damping = 0.0f;  // of the motion along the axis
  float bias = 1.0f;
  JointFrame joint_frame = {};  // x: direction
};

Joint makeSliderJoint(const RigidState& a, const RigidState& b, const SliderJointParams& params);

}  // namespace pfx
