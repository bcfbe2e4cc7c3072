// Reading a large mesh whichever way it is stored.
#include "pfx/base_level/shape/large_mesh.h"

#include <algorithm>

namespace pfx {
namespace {

Vec3 unpack(const std::array<int16_t, 3>& v) {
  return Vec3(v[0], v[1], v[2]) / 32767.0f;
}

template <class T>
size_t bytes(const MeshArray<T>& v) {
  return v.size() * sizeof(T);
}

}  // namespace

std::array<Vec3, 3> facetVertices(const LargeMesh& mesh, uint32_t facet) {
  if (isQuantized(mesh.type)) {
    const uint32_t base = mesh.vertex_blocks[facet / kMaxIslandFacets];
    const auto& v = mesh.quantized_facets[facet].vertex;
    return {gridToFloat(mesh, mesh.quantized_vertices[base + v[0]]),
            gridToFloat(mesh, mesh.quantized_vertices[base + v[1]]),
            gridToFloat(mesh, mesh.quantized_vertices[base + v[2]])};
  }
  const MeshIndices& t = mesh.triangles[facet];
  return {mesh.vertices[t[0]].position, mesh.vertices[t[1]].position, mesh.vertices[t[2]].position};
}

MeshTriangle meshTriangle(const LargeMesh& mesh, uint32_t facet) {
  if (!isQuantized(mesh.type)) {
    const MeshFacet& f = mesh.facets[facet];
    return {facetVertices(mesh, facet), f.normal, f.tilt, f.kind, f.thickness};
  }
  const QuantizedFacet& q = mesh.quantized_facets[facet];
  const Vec3 tilt = unpack(q.tilt);
  return {facetVertices(mesh, facet),
          unpack(q.normal).normalized(),
          {tilt.x(), tilt.y(), tilt.z()},
          {static_cast<EdgeKind>(q.kinds & 3), static_cast<EdgeKind>(q.kinds >> 2 & 3),
           static_cast<EdgeKind>(q.kinds >> 4 & 3)},
          mesh.max_thickness * (static_cast<float>(q.thickness) / 65535.0f)};
}

uint32_t islandOf(const LargeMesh& mesh, uint32_t facet) {
  const auto after = std::upper_bound(mesh.islands.begin(), mesh.islands.end(), facet,
                                      [](uint32_t f, const MeshIsland& island) { return f < island.first_facet; });
  return static_cast<uint32_t>(after - mesh.islands.begin()) - 1;
}

size_t memoryBytes(const LargeMesh& mesh) {
  return bytes(mesh.islands) + bytes(mesh.neighbors) + bytes(mesh.source) + bytes(mesh.user_data) +
         bytes(mesh.vertices) + bytes(mesh.triangles) + bytes(mesh.facets) + bytes(mesh.nodes) +
         bytes(mesh.quantized_vertices) + bytes(mesh.vertex_source) + bytes(mesh.vertex_blocks) +
         bytes(mesh.quantized_facets) + bytes(mesh.quantized_nodes);
}

}  // namespace pfx
