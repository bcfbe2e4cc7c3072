// The collision shapes of one body, with their bounds in the body frame.
//
// One shape is stored inside; several lie in an array of the caller, which must outlive the collidable. Call
// finish() after the last change: until then the bounds are not those of the shapes.
#pragma once

#include <span>

#include "pfx/base_level/error.h"
#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

class DynamicTree;  // low_level/broadphase/dynamic_tree.h

struct Collidable {
  Shape inline_shape;               // the shape, when external is empty
  std::span<const Shape> external;  // several shapes, owned by the caller
  Vec3 center = Vec3::Zero();       // m, of the local bounds, body frame
  Vec3 half_extent = Vec3::Zero();  // m
  // Of `external`, for bodies of many shapes, owned by the caller; may be null. See low_level/broadphase/shape_tree.h.
  const DynamicTree* shape_tree = nullptr;

  std::span<const Shape> shapes() const { return external.empty() ? std::span(&inline_shape, 1) : external; }

  // Computes the local bounds. Error::InvalidValue for a negative or non-finite size, Error::NullPointer for
  // a missing mesh.
  Error finish();
};

// Whether the geometry is a mesh that is not there, or one without faces.
bool isMissing(const Geometry& geometry);

// Bounds of one shape in the frame that `pose` maps the shape frame to (m). Empty for a missing mesh.
Aabb shapeAabb(const Geometry& geometry, const Transform& pose);

}  // namespace pfx
