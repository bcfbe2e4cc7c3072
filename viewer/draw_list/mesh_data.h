// Triangles of a solid, ready to be drawn: three vertices a triangle, each with a normal and with what the
// shader needs to draw the feature edges of its triangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pfx/base_level/math/vector.h"
#include "pfx/base_level/shape/aabb.h"

namespace viewer {

// `edge` holds, for the three edges of the triangle, the distance of this vertex from the edge in units of
// the triangle's height over it: 0 on the edge, 1 at the opposite corner. kPlainEdge is added to the values
// of an edge that is not a feature edge. Dividing an interpolated value by its screen-space derivative gives
// the distance in pixels.
struct MeshVertex {
  pfx::Vec3 position;  // m, shape frame
  pfx::Vec3 normal;    // unit, outwards
  pfx::Vec3 edge;
};
static_assert(sizeof(MeshVertex) == 36);

inline constexpr float kPlainEdge = 2.0f;

struct MeshData {
  std::vector<MeshVertex> vertices;  // (3 x triangles)
  // The same triangles for passes that need no more than places: each place once, and (3 x triangles) indices.
  std::vector<pfx::Vec3> positions;  // m, shape frame
  std::vector<uint32_t> indices;
  pfx::Aabb bounds;  // m, of the vertices

  void append(const MeshData& other);  // its triangles too
};

// Edges whose faces meet at more than 30 degrees are feature edges, and normals are smooth across the others.
inline constexpr float kCosFeatureAngle = 0.8660254f;

// Builds flat-or-smooth triangles with feature edges from an indexed mesh (indices: 3 per triangle,
// counter-clockwise seen from outside). Indices out of range and triangles without area are left out.
MeshData makeMesh(std::span<const pfx::Vec3> points, std::span<const uint32_t> indices);

// Unit solids, placed by an instance's scale: box of half extent 1, cylinder along X with half length 1 and
// radius 1.
MeshData makeUnitBox();
MeshData makeUnitCylinder();

}  // namespace viewer
