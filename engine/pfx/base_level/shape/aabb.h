// Axis-aligned bounding box.
#pragma once

#include "pfx/base_level/math/transform.h"

namespace pfx {

struct Aabb {
  Vec3 min = Vec3::Constant(1e30f);  // an empty box has min > max
  Vec3 max = Vec3::Constant(-1e30f);

  Vec3 center() const { return 0.5f * (min + max); }
  Vec3 halfExtent() const { return 0.5f * (max - min); }
  bool overlaps(const Aabb& b) const {
    return min.x() <= b.max.x() && b.min.x() <= max.x() && min.y() <= b.max.y() && b.min.y() <= max.y() &&
           min.z() <= b.max.z() && b.min.z() <= max.z();
  }
  bool contains(const Aabb& b) const {
    return (min.array() <= b.min.array()).all() && (b.max.array() <= max.array()).all();
  }
  void extend(const Vec3& p) { min = min.cwiseMin(p), max = max.cwiseMax(p); }
  void extend(const Aabb& b) { min = min.cwiseMin(b.min), max = max.cwiseMax(b.max); }
  Aabb grown(float margin) const { return {min - Vec3::Constant(margin), max + Vec3::Constant(margin)}; }
};

// Bounds of a box (centre, half extent, in the frame of `pose`) in the world.
inline Aabb transformedAabb(const Transform& pose, const Vec3& center, const Vec3& half_extent) {
  const Mat3 r = pose.orientation.toRotationMatrix();
  const Vec3 c = pose.position + r * center;
  const Vec3 h = r.cwiseAbs() * half_extent;
  return {c - h, c + h};
}

}  // namespace pfx
