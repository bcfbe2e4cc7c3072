// A manifold while the pair functions work on it: everything in the frame of the first shape, no history.
#pragma once

#include <array>
#include <cstdint>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/math/transform.h"

namespace pfx {

// Left uninitialized on purpose: the clipper has room for hundreds of them.
struct LocalContact {
  Vec3 point_a;      // m, on A, frame of A
  Vec3 point_b;      // m, on B, frame of A
  float distance;    // m, (point_b - point_a) . normal
  uint32_t feature;  // names the pair of features
};

// A contact between two points that do not lie exactly opposite each other: what they are apart across the
// normal is shared between them.
inline LocalContact oppositePoints(const Vec3& on_a, const Vec3& on_b, const Vec3& normal, uint32_t feature) {
  const Vec3 gap = on_b - on_a;
  const float distance = gap.dot(normal);
  const Vec3 a = on_a + 0.5f * (gap - distance * normal);
  return {a, a + distance * normal, distance, feature};
}

struct LocalManifold {
  Vec3 normal = Vec3::UnitY();  // unit, from A to B, frame of A
  int num_points = 0;
  std::array<LocalContact, kMaxContactPoints> points;

  void add(const LocalContact& c) { points[num_points++] = c; }
};

// Smallest distance of its points; a large number when there is none (m).
inline float deepest(const LocalManifold& m) {
  float distance = 1e30f;
  for (int i = 0; i < m.num_points; ++i)
    distance = m.points[i].distance < distance ? m.points[i].distance : distance;
  return distance;
}

// Pose of B seen from A, with the rotation as a matrix because many points go through it.
struct RelativePose {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();  // m

  RelativePose() = default;
  explicit RelativePose(const Transform& b_in_a)
      : rotation(b_in_a.orientation.toRotationMatrix()), position(b_in_a.position) {}
  RelativePose(const Mat3& r, const Vec3& p) : rotation(r), position(p) {}

  Vec3 toA(const Vec3& p_b) const { return rotation * p_b + position; }
  Vec3 toB(const Vec3& p_a) const { return rotation.transpose() * (p_a - position); }
  Vec3 rotateToB(const Vec3& v_a) const { return rotation.transpose() * v_a; }
  RelativePose inverse() const { return {rotation.transpose(), rotation.transpose() * -position}; }
};

}  // namespace pfx
