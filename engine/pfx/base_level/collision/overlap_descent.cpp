// The descent ends at an axis whose own closest points are the deepest points of the overlap.
#include "pfx/base_level/collision/overlap_descent.h"

#include <algorithm>

#include "pfx/base_level/collision/gjk.h"

namespace pfx {
namespace {

constexpr int kMaxSteps = 16;
constexpr float kPull = 0.02f;      // of the smaller core: the gap at which the next axis is measured
constexpr float kProgress = 1e-6f;  // of the smaller core: less than this ends the descent

// Size of a core for tolerances: half the extent along its thinnest direction, or the whole of a segment or point.
float thickness(const ConvexCore& core) {
  switch (core.kind) {
    case ConvexCore::Kind::Box: return core.size.minCoeff();
    case ConvexCore::Kind::Cylinder: return std::min(core.size.x(), core.size.y());
    case ConvexCore::Kind::Polytope: return core.polytope->inner_radius;
    case ConvexCore::Kind::Segment: return std::max(core.size.x(), core.radius);
    case ConvexCore::Kind::Point: break;
  }
  return core.radius;
}

}  // namespace

float separationAlong(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a, const Vec3& axis) {
  const Vec3 on_a = a.support(axis).point, on_b = b.support(-b_in_a.rotateToB(axis)).point;
  return axis.dot(b_in_a.toA(on_b) - on_a);
}

CoreAxis descendOverlap(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a, std::span<const Vec3> candidates) {
  CoreAxis best;
  for (const Vec3& n : candidates) {
    const float separation = separationAlong(a, b, b_in_a, n);
    if (separation > best.separation) best.normal = n, best.separation = separation;
  }
  const float size = std::min(thickness(a), thickness(b));
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3 shift = (kPull * size - best.separation) * best.normal;
    const RelativePose pulled(b_in_a.rotation, b_in_a.position + shift);
    const GjkResult gjk = gjkDistance({a, b, pulled, best.normal});
    if (gjk.state != GjkResult::State::Separated) break;
    best.point_a = gjk.point_a;
    best.point_b = gjk.point_b - shift;
    const float separation = separationAlong(a, b, b_in_a, gjk.normal);
    const float gain = separation - best.separation;
    if (gain > 0.0f) best.normal = gjk.normal, best.separation = separation;
    if (!(gain > kProgress * size)) break;
  }
  return best;
}

}  // namespace pfx
