// The core of a convex shape: what is left when its rounding radius is taken off. A sphere is a rounded
// point, a capsule a rounded segment; box, cylinder and convex mesh have no rounding, so the shape simulated
// is the shape given.
#pragma once

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

struct ConvexCore {
  enum class Kind : uint8_t { Point, Segment, Box, Cylinder, Polytope };

  Kind kind = Kind::Point;
  float radius = 0.0f;  // m, rounding
  Vec3 size =
      Vec3::Zero();  // m; segment: x = half length; box: half extents; cylinder: x = half length, y = radius
  const Polytope* polytope = nullptr;  // kind Polytope only

  struct Support {
    Vec3 point;   // m, frame of the core
    uint32_t id;  // equal ids mean equal points; of smooth surfaces always kSmooth
  };
  static constexpr uint32_t kSmooth = 0xffffffffu;

  // A point of the core that lies farthest along `direction` (any length but zero).
  Support support(const Vec3& direction) const;

  // m, of a ball around the frame's origin that holds the core.
  float outerRadius() const;
  Vec3 center() const { return kind == Kind::Polytope ? polytope->center : Vec3::Zero(); }
};

ConvexCore pointCore(float radius);
ConvexCore segmentCore(const Capsule& capsule);
ConvexCore boxCore(const Box& box);
ConvexCore cylinderCore(const Cylinder& cylinder);
ConvexCore polytopeCore(const Polytope& polytope);

}  // namespace pfx
