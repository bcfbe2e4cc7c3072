// Bounds of shapes and collidables, and the checks of their sizes.
#include "pfx/base_level/shape/collidable.h"

#include <cmath>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {
namespace {

bool isSize(float x) { return std::isfinite(x) && x >= 0.0f; }

Error check(const Sphere& s) { return isSize(s.radius) ? Error::Ok : Error::InvalidValue; }
Error check(const Box& b) {
  return isSize(b.half_extent.x()) && isSize(b.half_extent.y()) && isSize(b.half_extent.z())
             ? Error::Ok
             : Error::InvalidValue;
}
Error check(const Capsule& c) {
  return isSize(c.half_length) && isSize(c.radius) ? Error::Ok : Error::InvalidValue;
}
Error check(const Cylinder& c) {
  return isSize(c.half_length) && isSize(c.radius) ? Error::Ok : Error::InvalidValue;
}
Error check(const ConvexMesh* mesh) { return mesh != nullptr ? Error::Ok : Error::NullPointer; }
Error check(const LargeMesh* mesh) { return mesh != nullptr ? Error::Ok : Error::NullPointer; }

Error check(const Shape& shape) {
  const Transform& t = shape.offset;
  const bool finite = t.position.allFinite() && t.orientation.coeffs().allFinite();
  if (!finite || std::abs(t.orientation.squaredNorm() - 1.0f) > 1e-3f) return Error::InvalidValue;
  return std::visit([](const auto& g) { return check(g); }, shape.geometry);
}

Aabb bounds(const Sphere& s, const Transform& pose) {
  return Aabb{pose.position, pose.position}.grown(s.radius);
}
Aabb bounds(const Box& b, const Transform& pose) {
  return transformedAabb(pose, Vec3::Zero(), b.half_extent);
}
Aabb bounds(const Capsule& c, const Transform& pose) {
  return transformedAabb(pose, Vec3::Zero(), Vec3(c.half_length, 0.0f, 0.0f)).grown(c.radius);
}
// A disc with unit normal n reaches r sqrt(1 - n_i^2) along axis i.
Aabb bounds(const Cylinder& c, const Transform& pose) {
  const Vec3 n = pose.orientation * Vec3::UnitX();
  const Vec3 disc = (Vec3::Ones() - n.cwiseProduct(n)).cwiseMax(0.0f).cwiseSqrt();
  const Vec3 h = c.half_length * n.cwiseAbs() + c.radius * disc;
  return {pose.position - h, pose.position + h};
}
Aabb bounds(const ConvexMesh* mesh, const Transform& pose) {
  if (mesh == nullptr) return {};
  const Mat3 r = pose.orientation.toRotationMatrix();
  Aabb box;
  for (const Vec3& v : mesh->vertices) box.extend(Vec3(pose.position + r * v));
  return box;
}
Aabb bounds(const LargeMesh* mesh, const Transform& pose) {
  if (mesh == nullptr) return {};
  return transformedAabb(pose, mesh->bounds.center(), mesh->bounds.halfExtent());
}

}  // namespace

bool isMissing(const Geometry& geometry) {
  if (const auto* convex = std::get_if<const ConvexMesh*>(&geometry)) return *convex == nullptr || (*convex)->faces.empty();
  if (const auto* large = std::get_if<const LargeMesh*>(&geometry)) return *large == nullptr || (*large)->numFacets() == 0;
  return false;
}

Aabb shapeAabb(const Geometry& geometry, const Transform& pose) {
  return std::visit([&](const auto& g) { return bounds(g, pose); }, geometry);
}

Error Collidable::finish() {
  Aabb box;
  for (const Shape& shape : shapes()) {
    if (const Error error = check(shape); error != Error::Ok) return error;
    box.extend(shapeAabb(shape.geometry, shape.offset));
  }
  center = box.center();
  half_extent = box.halfExtent();
  return Error::Ok;
}

}  // namespace pfx
