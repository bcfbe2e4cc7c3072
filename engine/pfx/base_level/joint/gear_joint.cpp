#include "pfx/base_level/joint/gear_joint.h"

namespace pfx {

Joint makeGearJoint(const RigidState& a, const RigidState& b, const GearJointParams& params) {
  Joint j = placeJoint(JointKind::Gear, a, b, a.position, frameAround(params.axis_a));
  j.anchor_b = Vec3::Zero();
  j.gear_zero_a = Quat(frameAround(params.axis_a)).normalized();
  j.gear_zero_b = Quat(frameAround(params.axis_b)).normalized();
  j.frame_b = (b.orientation.conjugate() * j.gear_zero_b).normalized();
  j.gear_ratio = params.ratio;
  fixAxes(j, 3, 3);
  return j;
}

}  // namespace pfx
