#include "pfx/base_level/joint/swing_twist_joint.h"

namespace pfx {

Joint makeSwingTwistJoint(const RigidState& a, const RigidState& b, const SwingTwistJointParams& params) {
  const Mat3 frame = params.joint_frame.value_or(frameAround(params.twist_axis));
  Joint j = placeJoint(JointKind::SwingTwist, a, b, params.anchor_point, frame);
  j.cone = true;
  fixAxes(j, 0, 2);
  limitAxis(j.axis[3], params.twist_lower_angle, params.twist_upper_angle);
  limitAxis(j.axis[4], params.swing_lower_angle, params.swing_upper_angle);
  j.axis[3].damping = j.axis[4].damping = params.damping;
  for (AxisConstraint& axis : j.axis) axis.bias = params.bias;
  return j;
}

}  // namespace pfx
