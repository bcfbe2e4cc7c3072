#include "pfx/base_level/joint/slider_joint.h"

namespace pfx {

Joint makeSliderJoint(const RigidState& a, const RigidState& b, const SliderJointParams& params) {
  const Mat3 frame = params.joint_frame.value_or(frameAround(params.direction));
  Joint j = placeJoint(JointKind::Slider, a, b, params.anchor_point, frame);
  fixAxes(j, 1, 5);
  limitAxis(j.axis[0], params.lower_distance, params.upper_distance);
  j.axis[0].damping = params.damping;
  for (AxisConstraint& axis : j.axis) axis.bias = params.bias;
  return j;
}

}  // namespace pfx
