// Convex mesh: a closed convex polyhedron with polygonal faces, prepared for collision detection.
#pragma once

#include <vector>

#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/polytope.h"

namespace pfx {

// Built by buildConvexMesh() or checkConvexMesh() (shape/convex_hull.h); read only afterwards. Coplanar
// triangles are merged, so that a face is one polygon and an edge has two faces that really differ.
struct ConvexMesh {
  std::vector<Vec3> vertices;
  std::vector<Plane> planes;
  std::vector<PolytopeFace> faces;
  std::vector<uint16_t> face_vertices;
  std::vector<PolytopeEdge> edges;
  Aabb bounds;                   // m, in the shape frame
  Vec3 centroid = Vec3::Zero();  // m, centre of volume
  float inner_radius = 0.0f;     // m, of the largest ball around the centroid that fits inside
  float outer_radius = 0.0f;     // m, of the smallest ball around the origin of the shape frame that holds it
  float volume = 0.0f;           // m^3
  Mat3 unit_inertia = Mat3::Zero();     // m^5, about the centroid at a density of 1 kg/m^3
  std::vector<Vec3x4> packed_vertices;  // vertices and normals once more, for searches
  std::vector<Vec3x4> packed_normals;

  Polytope view() const {
    return {vertices, planes,       faces,           face_vertices, edges,
            centroid, inner_radius, packed_vertices, packed_normals};
  }
};

}  // namespace pfx
