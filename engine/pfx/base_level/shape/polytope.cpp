// The polytope of a box: fixed topology, vertices from the half extents.
#include "pfx/base_level/shape/polytope.h"

namespace pfx {
namespace {

// Vertex i has sign + on axis k when bit k of i is set. Face 2k looks along +k, face 2k + 1 along -k.
constexpr uint16_t kFaceVertices[24] = {1, 3, 7, 5, 0, 4, 6, 2, 2, 6, 7, 3, 0, 1, 5, 4, 4, 5, 7, 6, 0, 2, 3, 1};
constexpr PolytopeFace kFaces[6] = {{0, 4}, {4, 4}, {8, 4}, {12, 4}, {16, 4}, {20, 4}};
constexpr PolytopeEdge kEdges[12] = {{0, 1, 3, 5}, {3, 2, 2, 5}, {5, 4, 3, 4}, {6, 7, 2, 4},
                                     {2, 0, 1, 5}, {1, 3, 0, 5}, {4, 6, 1, 4}, {7, 5, 0, 4},
                                     {0, 4, 1, 3}, {5, 1, 0, 3}, {6, 2, 1, 2}, {3, 7, 0, 2}};

}  // namespace

BoxPolytope::BoxPolytope(const Vec3& h) : inner_radius(h.minCoeff()) {
  for (int i = 0; i < 8; ++i) {
    vertices[i] = Vec3(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z());
  }
  for (int f = 0; f < 6; ++f) {
    planes[f].normal = Vec3::Zero();
    planes[f].normal[f / 2] = f & 1 ? -1.0f : 1.0f;
    planes[f].offset = h[f / 2];
  }
}

Polytope BoxPolytope::view() const {
  return {vertices, planes, kFaces, kFaceVertices, kEdges, Vec3::Zero(), inner_radius};
}

}  // namespace pfx
