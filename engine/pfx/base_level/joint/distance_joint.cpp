#include "pfx/base_level/joint/distance_joint.h"

namespace pfx {

Joint makeDistanceJoint(const RigidState& a, const RigidState& b, const DistanceJointParams& params) {
  Joint j = placeJoint(JointKind::Distance, a, b, params.anchor_point_a, Mat3::Identity());
  j.anchor_b = b.pose().applyInverse(params.anchor_point_b);
  const float length = (params.anchor_point_b - params.anchor_point_a).norm();
  AxisConstraint& axis = j.axis[0];
  limitAxis(axis, params.lower_distance, params.upper_distance);
  axis.spring_frequency = params.spring_frequency;
  axis.spring_damping = params.spring_damping;
  axis.spring_target = length;
  const bool rod = axis.lock == JointLock::Free && params.spring_frequency <= 0.0f;
  if (rod) axis.lock = JointLock::Fixed, axis.lower = axis.upper = length;
  return j;
}

}  // namespace pfx
