#include "pfx/base_level/joint/ball_joint.h"

namespace pfx {

Joint makeBallJoint(const RigidState& a, const RigidState& b, const BallJointParams& params) {
  Joint j = placeJoint(JointKind::Ball, a, b, params.anchor_point, Mat3::Identity());
  fixAxes(j, 0, 2);
  for (int i = 0; i < 3; ++i) j.axis[i].bias = params.bias;
  for (int i = 3; i < 6; ++i) j.axis[i].damping = params.damping;
  return j;
}

}  // namespace pfx
