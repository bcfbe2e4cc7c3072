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

struct Collidable {
  Shape inline_shape;               // the shape, when external is empty
  std::span<const Shape> external;  // several shapes, owned by the caller
  Vec3 center = Vec3::Zero();       // m, of the local bounds, body frame
  Vec3 half_extent = Vec3::Zero();  // m

  std::span<const Shape> shapes() const { return external.empty() ? std::span(&inline_shape, 1) : external; }

  // Computes the local bounds. Error::InvalidValue for a negative or non-finite size, Error::NullPointer for
  // a missing mesh.
  Error finish();
};

// Bounds of one shape in the frame that `pose` maps the shape frame to (m).
Aabb shapeAabb(const Geometry& geometry, const Transform& pose);

}  // namespace pfx
