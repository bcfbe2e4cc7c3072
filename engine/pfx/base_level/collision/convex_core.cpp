// Support mappings of the cores.
#include "pfx/base_level/collision/convex_core.h"

#include <cmath>

namespace pfx {
namespace {

ConvexCore::Support boxSupport(const Vec3& h, const Vec3& d) {
  const bool x = d.x() >= 0.0f, y = d.y() >= 0.0f, z = d.z() >= 0.0f;
  return {Vec3(x ? h.x() : -h.x(), y ? h.y() : -h.y(), z ? h.z() : -h.z()),
          uint32_t(x) | uint32_t(y) << 1 | uint32_t(z) << 2};
}

ConvexCore::Support cylinderSupport(float half_length, float radius, const Vec3& d) {
  const float x = d.x() >= 0.0f ? half_length : -half_length;
  const float radial = std::sqrt(d.y() * d.y() + d.z() * d.z());
  if (!(radial > 0.0f)) return {Vec3(x, radius, 0.0f), ConvexCore::kSmooth};
  const float k = radius / radial;
  return {Vec3(x, k * d.y(), k * d.z()), ConvexCore::kSmooth};
}

}  // namespace

ConvexCore::Support ConvexCore::support(const Vec3& d) const {
  switch (kind) {
    case Kind::Point:
      break;
    case Kind::Segment: {
      const bool positive = d.x() >= 0.0f;
      return {Vec3(positive ? size.x() : -size.x(), 0.0f, 0.0f), uint32_t(positive)};
    }
    case Kind::Box:
      return boxSupport(size, d);
    case Kind::Cylinder:
      return cylinderSupport(size.x(), size.y(), d);
    case Kind::Polytope: {
      const uint32_t v = farthestVertex(*polytope, d);
      return {polytope->vertices[v], v};
    }
  }
  return {Vec3::Zero(), 0};
}

float ConvexCore::outerRadius() const {
  if (kind != Kind::Polytope) return size.norm();
  float squared = 0.0f;
  for (const Vec3& v : polytope->vertices) squared = std::max(squared, v.squaredNorm());
  return std::sqrt(squared);
}

ConvexCore pointCore(float radius) { return {ConvexCore::Kind::Point, radius, Vec3::Zero(), nullptr}; }
ConvexCore segmentCore(const Capsule& c) {
  return {ConvexCore::Kind::Segment, c.radius, Vec3(c.half_length, 0.0f, 0.0f), nullptr};
}
ConvexCore boxCore(const Box& b) { return {ConvexCore::Kind::Box, 0.0f, b.half_extent, nullptr}; }
ConvexCore cylinderCore(const Cylinder& c) {
  return {ConvexCore::Kind::Cylinder, 0.0f, Vec3(c.half_length, c.radius, 0.0f), nullptr};
}
ConvexCore polytopeCore(const Polytope& p) { return {ConvexCore::Kind::Polytope, 0.0f, Vec3::Zero(), &p}; }

}  // namespace pfx
