// Undoes the ordering of facets that the mesh builder makes.
#include "pfx/high_level/scene_file/mesh_source.h"

#include <algorithm>
#include <numeric>

namespace pfx {
namespace {

uint32_t vertexSource(const LargeMesh& mesh, uint32_t facet, int corner) {
  const auto k = static_cast<size_t>(corner);
  if (!isQuantized(mesh.type)) return mesh.vertices[mesh.triangles[facet][k]].source;
  const uint32_t block = mesh.vertex_blocks[facet / kMaxIslandFacets];
  return mesh.vertex_source[block + mesh.quantized_facets[facet].vertex[k]];
}

// Whether the builder makes facets of the same triangles in the same places.
bool hasOrderOf(const LargeMesh& mesh, const LargeMeshSource& s, bool high_quality) {
  const LargeMeshOptions options{.type = mesh.type,
                                 .high_quality = high_quality,
                                 .triangle_thickness = s.thickness,
                                 .user_data = s.user_data};
  const LargeMeshResult built = buildLargeMesh(s.vertices, s.indices, options);
  if (built.error != Error::Ok || built.mesh.numFacets() != mesh.numFacets()) return false;
  for (uint32_t f = 0; f < mesh.numFacets(); ++f)
    if (facetVertices(mesh, f) != facetVertices(built.mesh, f)) return false;
  return true;
}

bool isBefore(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Building makes one vertex of those at equal positions, the first of them, and leaves the others without a facet. Does
// the same here, so that what is read from what was written is written the same again: vertices that no facet uses
// stand where the first used one does, and each position goes by its first vertex.
void joinEqualVertices(LargeMeshSource& s) {
  std::vector<uint8_t> used(s.vertices.size());
  const auto by_position = [&](uint32_t a, uint32_t b) {
    if (s.vertices[a] != s.vertices[b]) return isBefore(s.vertices[a], s.vertices[b]);
    return a < b;
  };
  std::vector<uint32_t> order(s.vertices.size()), first(s.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto lead_to_first = [&] {
    std::sort(order.begin(), order.end(), by_position);
    for (size_t i = 0; i < order.size(); ++i) {
      const bool equal = i > 0 && s.vertices[order[i]] == s.vertices[order[i - 1]];
      first[order[i]] = equal ? first[order[i - 1]] : order[i];
    }
    for (uint32_t& v : s.indices) v = first[v];
  };
  lead_to_first();
  for (uint32_t v : s.indices) used[v] = 1;
  const auto first_used = std::find(used.begin(), used.end(), uint8_t(1));
  if (first_used == used.end()) return;
  const Vec3 place = s.vertices[static_cast<size_t>(first_used - used.begin())];
  for (size_t v = 0; v < used.size(); ++v)
    if (!used[v]) s.vertices[v] = place;
  lead_to_first();
}

}  // namespace

LargeMeshSource sourceOf(const LargeMesh& mesh) {
  LargeMeshSource out;
  out.vertices.assign(mesh.num_source_vertices, mesh.surface_bounds.min);
  std::vector<uint32_t> order(mesh.numFacets());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return mesh.source[a] < mesh.source[b]; });
  for (uint32_t f : order) {
    const MeshTriangle t = meshTriangle(mesh, f);
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = vertexSource(mesh, f, k);
      out.vertices[v] = t.vertex[static_cast<size_t>(k)];
      out.indices.push_back(v);
    }
    out.thickness.push_back(t.thickness);
    if (!mesh.user_data.empty()) out.user_data.push_back(mesh.user_data[f]);
  }
  joinEqualVertices(out);
  out.high_quality = !hasOrderOf(mesh, out, false) && hasOrderOf(mesh, out, true);
  return out;
}

}  // namespace pfx
