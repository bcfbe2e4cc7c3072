#include "pfx/base_level/shape/mesh_check.h"

#include <algorithm>

namespace pfx {
namespace {

bool areFinite(std::span<const Vec3> points) {
  return std::ranges::all_of(points, [](const Vec3& p) { return p.allFinite(); });
}

// Children come after their parents, so that no path runs in a circle.
template <class Nodes>
bool childrenAreThere(const Nodes& nodes, uint32_t facets) {
  for (size_t i = 0; i < nodes.size(); ++i)
    for (MeshChild c : nodes[i].child) {
      if (c == kNoChild) continue;
      if (isLeaf(c) ? uint64_t(leafFirst(c)) + leafCount(c) > facets : c <= i || c >= nodes.size())
        return false;
    }
  return true;
}

}  // namespace

bool isConsistent(const ConvexMesh& m) {
  const auto face_ok = [&](const PolytopeFace& f) {
    return f.count >= 3 && f.count <= kMaxFaceVertices &&
           uint64_t(f.first) + f.count <= m.face_vertices.size();
  };
  const auto edge_ok = [&](const PolytopeEdge& e) {
    return std::max(e.v0, e.v1) < m.vertices.size() && std::max(e.left, e.right) < m.faces.size();
  };
  return areFinite(m.vertices) && m.vertices.size() >= 4 && m.faces.size() >= 4 &&
         m.planes.size() == m.faces.size() && std::ranges::all_of(m.faces, face_ok) &&
         std::ranges::all_of(m.edges, edge_ok) &&
         std::ranges::all_of(m.face_vertices, [&](uint16_t v) { return v < m.vertices.size(); });
}

bool isConsistent(const LargeMesh& m) {
  const uint32_t n = m.numFacets();
  const bool quantized = isQuantized(m.type);
  const size_t records = quantized ? m.quantized_facets.size() : m.facets.size();
  if (n == 0 || records != n || m.neighbors.size() != n || (!m.user_data.empty() && m.user_data.size() != n))
    return false;
  for (const MeshIndices& sides : m.neighbors)
    for (uint32_t s : sides)
      if (s != kNoFacet && (s >> 2) >= n) return false;
  for (const MeshIsland& i : m.islands)
    if (i.num_facets == 0 || i.num_facets > kMaxIslandFacets || uint64_t(i.first_facet) + i.num_facets > n)
      return false;
  const bool has_nodes = quantized ? !m.quantized_nodes.empty() : !m.nodes.empty();
  if (!m.grid_scale.allFinite() || !m.surface_bounds.min.allFinite()) return false;
  if (m.islands.empty() || has_nodes != hasBvh(m.type)) return false;
  if (!childrenAreThere(m.nodes, n) || !childrenAreThere(m.quantized_nodes, n)) return false;
  for (const MeshVertex& v : m.vertices)
    if (v.source >= m.num_source_vertices || !v.position.allFinite()) return false;
  for (uint32_t v : m.vertex_source)
    if (v >= m.num_source_vertices) return false;
  if (!quantized) {
    return m.triangles.size() == n && std::ranges::all_of(m.triangles, [&](const MeshIndices& t) {
             return std::max({t[0], t[1], t[2]}) < m.vertices.size();
           });
  }
  if (m.vertex_blocks.size() < (n + 63) / 64 || m.vertex_source.size() != m.quantized_vertices.size())
    return false;
  for (uint32_t f = 0; f < n; ++f)
    for (uint8_t v : m.quantized_facets[f].vertex)
      if (uint64_t(m.vertex_blocks[f / 64]) + v >= m.quantized_vertices.size()) return false;
  return true;
}

}  // namespace pfx
