// Making convex meshes: the hull of points, or a given mesh after a check that it is convex.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/error.h"
#include "pfx/base_level/shape/convex_mesh.h"

namespace pfx {

// Builds the convex hull of `points` (m). Duplicates, inner points and points on faces or edges are dropped;
// points within about a millionth of the size count as lying on a face. Allocates. On error `mesh` is empty.
//   InvalidValue  a coordinate is not finite
//   Degenerate    fewer than four points, or all of them in one plane
//   OutOfRange    more than 65535 hull vertices, or a face with more than kMaxFaceVertices
Error buildConvexMesh(std::span<const Vec3> points, ConvexMesh& mesh);

// Builds the mesh of a closed triangle list (three indices a triangle, either winding). The errors of
// buildConvexMesh(), and
//   OutOfRange  the number of indices is not a multiple of three, or an index is too large
//   NotConvex   a triangle lies inside the hull of the vertices by more than a ten-thousandth of the size, or
//   triangles
//               are missing
Error checkConvexMesh(std::span<const Vec3> vertices, std::span<const uint32_t> triangles, ConvexMesh& mesh);

}  // namespace pfx
