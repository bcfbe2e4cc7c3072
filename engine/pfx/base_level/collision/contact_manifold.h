// What the narrow phase says about one pair of bodies, and what the solver remembers of it.
#pragma once

#include <array>
#include <cstdint>

#include "pfx/base_level/math/vector.h"

namespace pfx {

inline constexpr int kMaxContactPoints = 4;

struct ContactPoint {
  Vec3 local_a = Vec3::Zero();  // m, point on the surface of A, in the frame of body A
  Vec3 local_b = Vec3::Zero();  // m, point on the surface of B, in the frame of body B
  float distance = 0.0f;        // m along the normal at detection; negative: overlap
  uint32_t feature = 0;         // names the pair of features; equal features match from frame to frame
  uint32_t triangle = 0;        // on meshes: index of the triangle (island << 8 | facet for the overview's limits)
  Vec2 barycentric = Vec2::Zero();  // on meshes: (s, t) of the point in its triangle

  // Remembered by the solver, N s.
  float normal_impulse = 0.0f;
  Vec3 friction_impulse = Vec3::Zero();  // world axes, on B; tangential at the time it was stored
};

// Up to four points that share one normal. A pair of bodies has one manifold, or several when a body is a compound
// or a mesh.
struct ContactManifold {
  Vec3 normal = Vec3::UnitY();        // unit, world, from A to B
  Vec3 local_normal = Vec3::UnitY();  // the same in the frame of body A
  int num_points = 0;
  std::array<ContactPoint, kMaxContactPoints> points;
};

}  // namespace pfx
