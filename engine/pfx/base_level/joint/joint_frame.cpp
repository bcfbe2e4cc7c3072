#include "pfx/base_level/joint/joint_frame.h"

namespace pfx {

Mat3 frameAround(const Vec3& x, const Vec3& up) {
  const float length = x.norm();
  const Vec3 ex = length > 0.0f ? Vec3(x / length) : Vec3(Vec3::UnitX());
  const Vec3 side = ex.cross(up);
  Mat3 m;
  if (side.norm() > 1e-6f * up.norm()) {
    const Vec3 ez = side.normalized();
    m << ex, ez.cross(ex), ez;
  } else {
    const TangentPair t = tangents(ex);
    m << ex, t.t1, t.t2;
  }
  return m;
}

Joint placeJoint(JointKind kind, const RigidState& a, const RigidState& b, const Vec3& anchor,
                 const Mat3& frame) {
  const Quat world = Quat(frame).normalized();
  Joint j;
  j.kind = kind;
  j.anchor_a = a.pose().applyInverse(anchor);
  j.anchor_b = b.pose().applyInverse(anchor);
  j.frame_a = (a.orientation.conjugate() * world).normalized();
  j.frame_b = (b.orientation.conjugate() * world).normalized();
  return j;
}

void fixAxes(Joint& joint, int first, int last) {
  for (int i = first; i <= last; ++i) joint.axis[i] = {.lock = JointLock::Fixed};
}

void limitAxis(AxisConstraint& axis, float lower, float upper) {
  axis.lock = lower > upper ? JointLock::Free : JointLock::Limit;
  axis.lower = lower;
  axis.upper = upper;
}

}  // namespace pfx
