#include "pfx/base_level/joint/fixed_joint.h"

namespace pfx {

Joint makeFixedJoint(const RigidState& a, const RigidState& b, const FixedJointParams& params) {
  const Mat3 frame = params.joint_frame.value_or(Mat3::Identity());
  Joint j = placeJoint(JointKind::Fixed, a, b, params.anchor_point, frame);
  fixAxes(j, 0, 5);
  for (AxisConstraint& axis : j.axis) axis.bias = params.bias;
  return j;
}

}  // namespace pfx
