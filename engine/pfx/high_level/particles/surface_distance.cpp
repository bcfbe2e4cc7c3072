#include "pfx/high_level/particles/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/shape/mesh_query.h"

namespace pfx {
namespace {

// From a point that is `offset` away from the core of a round shape.
SurfaceDistance fromCore(const Vec3& offset, float radius, const Vec3& fallback) {
  const float length = offset.norm();
  return {length - radius, length > 0.0f ? Vec3(offset / length) : fallback};
}

// Nearest point of a triangle. Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
Vec3 nearestOnTriangle(const std::array<Vec3, 3>& v, const Vec3& p) {
  const Vec3 ab = v[1] - v[0], ac = v[2] - v[0];
  const Vec3 a = p - v[0], b = p - v[1], c = p - v[2];
  const float d1 = ab.dot(a), d2 = ac.dot(a), d3 = ab.dot(b), d4 = ac.dot(b), d5 = ab.dot(c), d6 = ac.dot(c);
  if (d1 <= 0.0f && d2 <= 0.0f) return v[0];
  if (d3 >= 0.0f && d4 <= d3) return v[1];
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return v[0] + d1 / (d1 - d3) * ab;
  if (d6 >= 0.0f && d5 <= d6) return v[2];
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return v[0] + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f)
    return v[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (v[2] - v[1]);
  const float scale = 1.0f / (va + vb + vc);
  return v[0] + scale * vb * ab + scale * vc * ac;
}

}  // namespace

SurfaceDistance surfaceDistance(const Sphere& s, const Vec3& p, float) {
  return fromCore(p, s.radius, Vec3::UnitY());
}

SurfaceDistance surfaceDistance(const Capsule& c, const Vec3& p, float) {
  return fromCore(p - Vec3(std::clamp(p.x(), -c.half_length, c.half_length), 0.0f, 0.0f), c.radius, Vec3::UnitY());
}

SurfaceDistance surfaceDistance(const Box& b, const Vec3& p, float) {
  const Vec3 beyond = p.cwiseAbs() - b.half_extent;
  const Vec3 outside = beyond.cwiseMax(0.0f);
  const Vec3 sign(p.x() < 0.0f ? -1.0f : 1.0f, p.y() < 0.0f ? -1.0f : 1.0f, p.z() < 0.0f ? -1.0f : 1.0f);
  const float distance = outside.norm();
  if (distance > 0.0f) return {distance, sign.cwiseProduct(outside) / distance};
  int axis = 0;
  const float depth = beyond.maxCoeff(&axis);
  return {depth, sign[axis] * Vec3::Unit(axis)};
}

SurfaceDistance surfaceDistance(const Cylinder& c, const Vec3& p, float) {
  const float from_axis = std::sqrt(p.y() * p.y() + p.z() * p.z());
  const Vec3 radial = from_axis > 0.0f ? Vec3(0.0f, p.y() / from_axis, p.z() / from_axis) : Vec3::UnitY();
  const Vec3 along(p.x() < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f);
  const float side = from_axis - c.radius, cap = std::abs(p.x()) - c.half_length;
  if (side > 0.0f && cap > 0.0f) {
    const float distance = std::sqrt(side * side + cap * cap);
    return {distance, (side * radial + cap * along) / distance};
  }
  return side > cap ? SurfaceDistance{side, radial} : SurfaceDistance{cap, along};
}

SurfaceDistance surfaceDistance(const ConvexMesh* mesh, const Vec3& p, float) {
  SurfaceDistance best{-1e30f, Vec3::UnitY()};
  for (const Plane& plane : mesh->planes) {
    const float distance = plane.normal.dot(p) - plane.offset;
    if (distance > best.distance) best = {distance, plane.normal};
  }
  return best;
}

SurfaceDistance surfaceDistance(const LargeMesh* mesh, const Vec3& p, float reach) {
  SurfaceDistance best;
  float nearest2 = 1e30f;
  const Aabb box = Aabb{p, p}.grown(std::max(reach, mesh->max_thickness));
  visitFacets(*mesh, box, [&](uint32_t first, uint32_t count) {
    for (uint32_t f = first; f < first + count; ++f) {
      const MeshTriangle t = meshTriangle(*mesh, f);
      const Vec3 offset = p - nearestOnTriangle(t.vertex, p);
      const float distance2 = offset.squaredNorm();
      if (distance2 >= nearest2) continue;
      const float height = t.normal.dot(p - t.vertex[0]);
      const float limit = height >= 0.0f ? reach : t.thickness;
      if (distance2 > limit * limit) continue;
      nearest2 = distance2;
      const float distance = std::sqrt(distance2);
      // Near the plane the direction of the offset is lost in rounding.
      const bool is_in_front = height > 0.0f && distance > 1e-6f;
      best = is_in_front ? SurfaceDistance{distance, offset / distance} : SurfaceDistance{-distance, t.normal};
    }
  });
  return best;
}

}  // namespace pfx
