// How far a point is from the surface of a shape, and which way is out.
#pragma once

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

struct SurfaceDistance {
  float distance = 1e30f;       // m, negative inside
  Vec3 normal = Vec3::UnitY();  // unit, outwards, shape frame
};

// Of a point in the frame of the shape (m). Spheres, boxes, capsules and cylinders: exact. Convex meshes: the largest
// distance from a plane, which is exact but near edges and corners from outside, where it is too small.
SurfaceDistance surfaceDistance(const Sphere& sphere, const Vec3& point, float reach);
SurfaceDistance surfaceDistance(const Box& box, const Vec3& point, float reach);
SurfaceDistance surfaceDistance(const Capsule& capsule, const Vec3& point, float reach);
SurfaceDistance surfaceDistance(const Cylinder& cylinder, const Vec3& point, float reach);
SurfaceDistance surfaceDistance(const ConvexMesh* mesh, const Vec3& point, float reach);
// Of the nearest facet within `reach` (m). Behind its front a facet counts as deep as it is thick.
SurfaceDistance surfaceDistance(const LargeMesh* mesh, const Vec3& point, float reach);

}  // namespace pfx
