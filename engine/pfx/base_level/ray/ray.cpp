// Rays against convex shapes: each gives the interval of the ray inside it, with the normals at both ends.
#include "pfx/base_level/ray/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/base_level/shape/convex_mesh.h"

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Part of the line inside a convex set; empty if enter > leave. Normals are outward and need not be unit.
struct Interval {
  double enter = -kInfinity, leave = kInfinity;
  Vec3d normal_enter = Vec3d::Zero(), normal_leave = Vec3d::Zero();
  uint32_t face_enter = kNoTriangle, face_leave = kNoTriangle;

  bool empty() const { return !(enter <= leave); }
};
const Interval kEmpty = {1.0, -1.0};

ShapeHit firstHit(const LocalRay& ray, const Interval& i) {
  const auto hit = [](double t, const Vec3d& n, uint32_t face) {
    return ShapeHit{true, t, n.normalized().cast<float>(), face, Vec2::Zero()};
  };
  if (i.empty() || ray.direction.isZero(0.0)) return {};
  if (ray.facet_mode != FacetMode::BackOnly && i.enter >= 0.0 && i.enter <= ray.max_fraction) {
    return hit(i.enter, i.normal_enter, i.face_enter);
  }
  if (ray.facet_mode != FacetMode::FrontOnly && i.leave >= 0.0 && i.leave <= ray.max_fraction) {
    return hit(i.leave, -i.normal_leave, i.face_leave);
  }
  return {};
}

// Keeps the part on the inner side of the plane normal . x <= offset.
void clip(const LocalRay& ray, const Vec3d& normal, double offset, uint32_t face, Interval& i) {
  const double speed = normal.dot(ray.direction), gap = offset - normal.dot(ray.start);
  if (speed == 0.0) {
    if (gap < 0.0) i = kEmpty;
    return;
  }
  const double t = gap / speed;
  if (speed < 0.0 && t > i.enter) i.enter = t, i.normal_enter = normal, i.face_enter = face;
  if (speed > 0.0 && t < i.leave) i.leave = t, i.normal_leave = normal, i.face_leave = face;
}

// Ball. The discriminant is taken at the point of closest approach, so that it does not cancel for far starts.
// Source: E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019.
Interval ballInterval(const LocalRay& ray, const Vec3d& center, double radius) {
  const Vec3d m = ray.start - center;
  const double a = ray.direction.squaredNorm();
  const double t = -m.dot(ray.direction) / a;
  const Vec3d q = m + t * ray.direction;
  const double rest = radius * radius - q.squaredNorm();
  if (!(rest >= 0.0)) return kEmpty;
  const double half = std::sqrt(rest / a);
  return {t - half, t + half, q - half * ray.direction, q + half * ray.direction};
}

// Endless cylinder about X.
Interval tubeInterval(const LocalRay& ray, double radius) {
  LocalRay flat = ray;
  flat.start.x() = 0.0;
  flat.direction.x() = 0.0;
  if (flat.direction.isZero(0.0)) return flat.start.norm() <= radius ? Interval{} : kEmpty;
  return ballInterval(flat, Vec3d::Zero(), radius);
}

void clipEnds(const LocalRay& ray, double half_length, Interval& i) {
  clip(ray, Vec3d::UnitX(), half_length, kNoTriangle, i);
  clip(ray, -Vec3d::UnitX(), half_length, kNoTriangle, i);
}

// The pieces of a convex union overlap, so that its interval spans theirs.
void join(const Interval& piece, Interval& sum) {
  if (piece.empty()) return;
  if (sum.empty()) {
    sum = piece;
    return;
  }
  if (piece.enter < sum.enter) sum.enter = piece.enter, sum.normal_enter = piece.normal_enter;
  if (piece.leave > sum.leave) sum.leave = piece.leave, sum.normal_leave = piece.normal_leave;
}

}  // namespace

LocalRay toLocal(const RayInput& ray, const Transform& pose) {
  const Eigen::Quaterniond to_local = pose.orientation.cast<double>().conjugate().normalized();
  return {to_local * (ray.start.cast<double>() - pose.position.cast<double>()),
          to_local * ray.direction.cast<double>(), 1.0, ray.facet_mode};
}

ShapeHit castRay(const LocalRay& ray, const Sphere& sphere) {
  if (ray.direction.isZero(0.0)) return {};
  return firstHit(ray, ballInterval(ray, Vec3d::Zero(), sphere.radius));
}

ShapeHit castRay(const LocalRay& ray, const Box& box) {
  Interval i;
  for (int axis = 0; axis < 3; ++axis) {
    clip(ray, Vec3d::Unit(axis), box.half_extent[axis], kNoTriangle, i);
    clip(ray, -Vec3d::Unit(axis), box.half_extent[axis], kNoTriangle, i);
  }
  return firstHit(ray, i);
}

ShapeHit castRay(const LocalRay& ray, const Capsule& capsule) {
  if (ray.direction.isZero(0.0)) return {};
  Interval sum = kEmpty;
  Interval side = tubeInterval(ray, capsule.radius);
  clipEnds(ray, capsule.half_length, side);
  join(ballInterval(ray, {-double(capsule.half_length), 0.0, 0.0}, capsule.radius), sum);
  join(ballInterval(ray, {double(capsule.half_length), 0.0, 0.0}, capsule.radius), sum);
  join(side, sum);
  return firstHit(ray, sum);
}

ShapeHit castRay(const LocalRay& ray, const Cylinder& cylinder) {
  Interval i = tubeInterval(ray, cylinder.radius);
  clipEnds(ray, cylinder.half_length, i);
  return firstHit(ray, i);
}

ShapeHit castRay(const LocalRay& ray, const ConvexMesh& mesh) {
  Interval i;
  for (uint32_t f = 0; f < mesh.planes.size() && !i.empty(); ++f) {
    clip(ray, mesh.planes[f].normal.cast<double>(), mesh.planes[f].offset, f, i);
  }
  return mesh.planes.empty() ? ShapeHit{} : firstHit(ray, i);
}

ShapeHit castRay(const LocalRay& ray, const Geometry& geometry) {
  const auto cast = [&](const auto& shape) {
    if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(shape)>>) {
      return castRay(ray, *shape);
    } else {
      return castRay(ray, shape);
    }
  };
  return std::visit(cast, geometry);
}

}  // namespace pfx
