// Builds large meshes from triangles, and follows vertices that move.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/error.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

struct LargeMeshOptions {
  LargeMeshType type = LargeMeshType::ExpandedBvh;
  bool high_quality = false;  // better islands and hierarchy for about twice the build time
  bool weld = true;           // vertices at exactly equal positions become one, so that edges find their neighbours
  float thickness = kDefaultThickness;          // m, >= 0
  std::span<const float> triangle_thickness{};  // m, (n_triangles) or empty: `thickness` for all
  std::span<const uint32_t> user_data{};        // (n_triangles) or empty
};

struct LargeMeshResult {
  Error error = Error::Ok;
  uint32_t where = 0;                 // the vertex, triangle or array length that `error` is about
  uint32_t dropped_degenerate = 0;    // triangles without area
  uint32_t dropped_duplicate = 0;     // triangles given before with the same corners and the same front
  LargeMesh mesh;
};

// The mesh of (n x 3) vertex indices. Errors, with an empty mesh:
//   Degenerate    no vertex, no triangle, or no triangle with an area;
//   InvalidValue  a coordinate is not finite or beyond 1e15 m, a thickness not finite or negative;
//   OutOfRange    an index >= n_vertices, a number of indices that is not a multiple of three, a per-triangle array of
//                 another length, or more than kMaxFacets triangles.
LargeMeshResult buildLargeMesh(std::span<const Vec3> vertices, std::span<const uint32_t> indices,
                               const LargeMeshOptions& options = {});

// Moves the vertices of a mesh to `vertices` (as many as it was built from) and recomputes everything that depends on
// positions: normals, edges, bounds, grid. Islands, hierarchy and neighbours keep their shape, so that a mesh that is
// deformed beyond recognition is searched more slowly, never wrongly. Allocates nothing.
// OutOfRange for another number of vertices, InvalidValue for one that is not finite or beyond 1e15 m; the mesh is then unchanged.
Error replaceVertices(LargeMesh& mesh, std::span<const Vec3> vertices);

}  // namespace pfx
