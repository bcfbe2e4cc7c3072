#include "pfx/base_level/joint/hinge_joint.h"

namespace pfx {

Joint makeHingeJoint(const RigidState& a, const RigidState& b, const HingeJointParams& params) {
  const Mat3 frame = params.joint_frame.value_or(frameAround(params.axis));
  Joint j = placeJoint(JointKind::Hinge, a, b, params.anchor_point, frame);
  fixAxes(j, 0, 2);
  fixAxes(j, 4, 5);
  limitAxis(j.axis[3], params.lower_angle, params.upper_angle);
  j.axis[3].damping = params.damping;
  for (AxisConstraint& axis : j.axis) axis.bias = params.bias;
  return j;
}

}  // namespace pfx
