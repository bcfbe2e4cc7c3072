// Distance joint: two points stay at a distance, or within a range of distances, like a rod or a rope.
#pragma once

#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

struct DistanceJointParams {
  Vec3 anchor_point_a = Vec3::Zero();  // m, world
  Vec3 anchor_point_b = Vec3::Zero();  // m, world
  float lower_distance = 1.0f;         // m; lower above upper: the distance at the start
  float upper_distance = -1.0f;
  float spring_frequency =
      0.0f;  // Hz; above zero: a spring towards the distance at the start, within the range
  float spring_damping = 0.0f;  // damping ratio
};

Joint makeDistanceJoint(const RigidState& a, const RigidState& b, const DistanceJointParams& params);

}  // namespace pfx
