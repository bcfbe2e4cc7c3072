#include "pfx/low_level/collision/recycle.h"

#include <algorithm>

namespace pfx {

bool hardlyMoved(const Contact& contact, const Transform& b_in_a, const PairRadii& radii, float tolerance) {
  // The motion since then is p -> turn (p - old) + now. A turn by the quaternion (w, u) moves a point at
  // distance r from its centre by at most 2 |u| r; as centre serves the origin of the smaller body.
  const Quat turn = b_in_a.orientation * contact.relative.orientation.conjugate();
  const Vec3 &old = contact.relative.position, &now = b_in_a.position;
  const float shift = radii.b <= radii.a ? (now - old).norm() : (now - turn * old).norm();
  return shift + 2.0f * turn.vec().norm() * std::min(radii.a, radii.b) <= tolerance;
}

void measureAgain(std::span<ContactManifold> manifolds, const Transform& pose_a, const Transform& pose_b) {
  const Mat3 ra = pose_a.orientation.toRotationMatrix(), rb = pose_b.orientation.toRotationMatrix();
  const Vec3 apart = pose_b.position - pose_a.position;
  for (ContactManifold& m : manifolds) {
    m.normal = ra * m.local_normal;
    for (int i = 0; i < m.num_points; ++i) {
      ContactPoint& p = m.points[i];
      p.distance = m.normal.dot(apart + (rb * p.local_b - ra * p.local_a));
    }
  }
}

}  // namespace pfx
