#include "pfx/base_level/joint/universal_joint.h"

namespace pfx {

Joint makeUniversalJoint(const RigidState& a, const RigidState& b, const UniversalJointParams& params) {
  const Mat3 frame = params.joint_frame.value_or(frameAround(params.axis, params.up_vec));
  Joint j = placeJoint(JointKind::Universal, a, b, params.anchor_point, frame);
  fixAxes(j, 0, 3);
  limitAxis(j.axis[4], params.swing1_lower_angle, params.swing1_upper_angle);
  limitAxis(j.axis[5], params.swing2_lower_angle, params.swing2_upper_angle);
  j.axis[4].damping = j.axis[5].damping = params.damping;
  for (AxisConstraint& axis : j.axis) axis.bias = params.bias;
  return j;
}

}  // namespace pfx
