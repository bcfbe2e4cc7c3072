// Helpers of the narrow-phase tests: poses, one call, and what every manifold must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "pfx/base_level/collision/pair_table.h"

namespace pfx::test {

inline Quat axisAngle(const Vec3& axis, float angle) {
  return Quat(Eigen::AngleAxisf(angle, axis.normalized()));
}

inline ContactManifold collide(const Shape& a, const Transform& pose_a, const Shape& b,
                               const Transform& pose_b, float margin = 0.02f, PairCache* cache = nullptr) {
  ContactManifold m;
  collideShapes({a, pose_a, b, pose_b, margin, cache}, m);
  return m;
}

inline float deepest(const ContactManifold& m) {
  float d = 1e30f;
  for (int i = 0; i < m.num_points; ++i) d = std::min(d, m.points[i].distance);
  return d;
}

// Distance of every point agrees with its two ends, the normal is a unit vector.
inline void expectConsistent(const ContactManifold& m, const Transform& pose_a, const Transform& pose_b,
                             float tolerance) {
  EXPECT_NEAR(m.normal.norm(), 1.0f, 1e-5f);
  for (int i = 0; i < m.num_points; ++i) {
    const Vec3 gap = pose_b.apply(m.points[i].local_b) - pose_a.apply(m.points[i].local_a);
    EXPECT_NEAR((gap - m.points[i].distance * m.normal).norm(), 0.0f, tolerance);
  }
}

struct Random {
  std::mt19937 engine;
  explicit Random(uint32_t seed) : engine(seed) {}

  float uniform(float lo, float hi) { return lo + (hi - lo) * float(engine() >> 8) * 0x1p-24f; }
  Vec3 vector(float size) {
    const float x = uniform(-size, size);
    const float y = uniform(-size, size);
    const float z = uniform(-size, size);
    return Vec3(x, y, z);
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1.0f);
      if (v.squaredNorm() > 0.01f && v.squaredNorm() < 1.0f) return v.normalized();
    }
  }
  Quat rotation() {
    for (;;) {
      const Vec3 v = vector(1.0f);
      const float w = uniform(-1.0f, 1.0f);
      const Quat q(w, v.x(), v.y(), v.z());
      if (q.squaredNorm() > 0.01f && q.squaredNorm() < 1.0f) return q.normalized();
    }
  }
};

}  // namespace pfx::test
