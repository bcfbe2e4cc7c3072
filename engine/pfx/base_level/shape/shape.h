// A shape: one geometry placed in the body frame.
//
// Primitives are held by value. Meshes are held by pointer: the caller owns them and they must outlive the shape.
#pragma once

#include <variant>

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/shape/primitives.h"

namespace pfx {

struct ConvexMesh;  // shape/convex_mesh.h
struct LargeMesh;   // shape/large_mesh.h

using Geometry = std::variant<Sphere, Box, Capsule, Cylinder, const ConvexMesh*, const LargeMesh*>;

// Equal to Geometry::index(); the row and column of the pair table.
enum class ShapeType : uint8_t { Sphere, Box, Capsule, Cylinder, ConvexMesh, LargeMesh };
inline constexpr int kNumShapeTypes = 6;

struct Shape {
  Geometry geometry = {};
  Transform offset = {};  // shape frame to body frame

  ShapeType type() const { return static_cast<ShapeType>(geometry.index()); }
};

}  // namespace pfx
