#include "pfx/low_level/collision/recycle.h"

namespace pfx {

bool hardlyMoved(const Contact& contact, const Transform& b_in_a, float radius_b, float tolerance) {
  const Quat turn = contact.relative.orientation.conjugate() * b_in_a.orientation;
  // A turn by the quaternion (w, u) moves a point at distance r by at most 2 |u| r.
  const float shift = (b_in_a.position - contact.relative.position).norm();
  return shift + 2.0f * turn.vec().norm() * radius_b <= tolerance;
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
