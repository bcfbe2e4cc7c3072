// A convex polytope as the collision functions see it: spans over data that a box, a convex mesh or a
// triangle owns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct Plane {
  Vec3 normal = Vec3::UnitY();  // unit, outwards
  float offset = 0.0f;          // m; the plane is normal . x == offset
};

struct PolytopeFace {
  uint32_t first = 0;  // into face_vertices
  uint32_t count = 0;  // at least three, counter-clockwise seen from outside
};

struct PolytopeEdge {
  uint16_t v0 = 0, v1 = 0;       // v0 -> v1 runs counter-clockwise around face left
  uint16_t left = 0, right = 0;  // the two faces
};

inline constexpr int kMaxFaceVertices = 255;

// Four vectors side by side, for searches over many of them.
struct alignas(16) Vec3x4 {
  float x[4], y[4], z[4];
};

// Appends `vectors` in groups of four; the last one fills up the last group.
std::vector<Vec3x4> packFours(std::span<const Vec3> vectors);

struct Polytope {
  std::span<const Vec3> vertices;
  std::span<const Plane> planes;  // one a face
  std::span<const PolytopeFace> faces;
  std::span<const uint16_t> face_vertices;
  std::span<const PolytopeEdge> edges;
  Vec3 center = Vec3::Zero();               // m, an inner point
  float inner_radius = 0.0f;                // m, of a ball around center that fits inside
  std::span<const Vec3x4> packed_vertices;  // the same once more for searches; may be empty
  std::span<const Vec3x4> packed_normals;

  std::span<const uint16_t> face(uint32_t f) const {
    return face_vertices.subspan(faces[f].first, faces[f].count);
  }
};

// The vertex that lies farthest along `direction`, and the face whose normal is closest to it; the first of
// several.
uint32_t farthestVertex(const Polytope& polytope, const Vec3& direction);
uint32_t supportingFace(const Polytope& polytope, const Vec3& direction);

// Storage for the polytope of a box.
struct BoxPolytope {
  explicit BoxPolytope(const Vec3& half_extent);
  Polytope view() const;

  Vec3 vertices[8];
  Plane planes[6];
  float inner_radius;
};

}  // namespace pfx
