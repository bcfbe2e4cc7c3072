// replaceVertices: positions -> grid, normals, edges, bounds of islands and nodes.
#include "pfx/util/mesh_builder/mesh_refit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/util/mesh_builder/mesh_builder.h"

namespace pfx {
namespace {

int16_t pack(float unit) { return static_cast<int16_t>(std::lround(std::clamp(unit, -1.0f, 1.0f) * 32767.0f)); }

// The cell that decodes nearest to x.
uint16_t toCell(float x, float origin, float scale) {
  if (!(scale > 0.0f)) return 0;
  const float cell = std::floor((x - origin) / scale + 0.5f);
  return static_cast<uint16_t>(std::clamp(cell, 0.0f, 65535.0f));
}

void placeVertices(LargeMesh& mesh, std::span<const Vec3> vertices) {
  Aabb box;
  if (!isQuantized(mesh.type)) {
    for (MeshVertex& v : mesh.vertices) {
      v.position = vertices[v.source];
      box.extend(v.position);
    }
    mesh.surface_bounds = box;
  } else {
    for (const uint32_t s : mesh.vertex_source) box.extend(vertices[s]);
    mesh.surface_bounds = box;
    mesh.grid_scale = (box.max - box.min) / 65535.0f;
    for (size_t i = 0; i < mesh.vertex_source.size(); ++i) {
      const Vec3& p = vertices[mesh.vertex_source[i]];
      for (int a = 0; a < 3; ++a) mesh.quantized_vertices[i][a] = toCell(p[a], box.min[a], mesh.grid_scale[a]);
    }
  }
  mesh.bounds = box.grown(mesh.max_thickness);
}

// Unit normal of the triangle as it is stored; of a sliver that the grid made flat: any unit vector.
Vec3 facetNormal(const std::array<Vec3, 3>& v) {
  const Eigen::Vector3d n =
      (v[1] - v[0]).cast<double>().cross((v[2] - v[0]).cast<double>());
  const double length = n.norm();
  return length > 0.0 ? Vec3((n / length).cast<float>()) : Vec3::UnitY();
}

Vec3 storedNormal(const LargeMesh& mesh, uint32_t f) {
  if (!isQuantized(mesh.type)) return mesh.facets[f].normal;
  const auto& n = mesh.quantized_facets[f].normal;
  return Vec3(n[0], n[1], n[2]).normalized();
}

void computeNormals(LargeMesh& mesh) {
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
    const Vec3 n = facetNormal(facetVertices(mesh, f));
    if (isQuantized(mesh.type)) {
      mesh.quantized_facets[f].normal = {pack(n.x()), pack(n.y()), pack(n.z())};
    } else {
      mesh.facets[f].normal = n;
    }
  }
}

struct EdgeShape {
  float tilt = 1.0f;
  EdgeKind kind = EdgeKind::Open;
};

// |n' - n| / 2 is |sin(phi / 2)|, exact for small angles too; convex if the neighbour falls away behind the front.
EdgeShape edgeShape(const LargeMesh& mesh, const std::array<Vec3, 3>& v, const Vec3& normal, uint32_t neighbor, int k) {
  if (neighbor == kNoFacet) return {};
  const uint32_t other = neighbor >> 2;
  const float tilt = std::min(1.0f, 0.5f * (storedNormal(mesh, other) - normal).norm());
  if (tilt < kFlatTilt) return {0.0f, EdgeKind::Flat};
  const Vec3 apex = facetVertices(mesh, other)[((neighbor & 3) + 2) % 3];
  const bool convex = normal.dot(apex - v[k]) <= 0.0f;
  return {convex ? tilt : -tilt, convex ? EdgeKind::Convex : EdgeKind::Concave};
}

void computeEdges(LargeMesh& mesh) {
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
    const auto v = facetVertices(mesh, f);
    const Vec3 normal = storedNormal(mesh, f);
    std::array<EdgeShape, 3> e;
    for (int k = 0; k < 3; ++k) e[k] = edgeShape(mesh, v, normal, mesh.neighbors[f][k], k);
    if (isQuantized(mesh.type)) {
      QuantizedFacet& q = mesh.quantized_facets[f];
      q.tilt = {pack(e[0].tilt), pack(e[1].tilt), pack(e[2].tilt)};
      q.kinds = static_cast<uint8_t>(static_cast<int>(e[0].kind) | static_cast<int>(e[1].kind) << 2 |
                                     static_cast<int>(e[2].kind) << 4);
    } else {
      for (int k = 0; k < 3; ++k) mesh.facets[f].tilt[k] = e[k].tilt, mesh.facets[f].kind[k] = e[k].kind;
    }
  }
}

Aabb facetBounds(const LargeMesh& mesh, uint32_t first, uint32_t count) {
  Aabb box;
  for (uint32_t f = first; f < first + count; ++f) {
    for (const Vec3& p : facetVertices(mesh, f)) box.extend(p);
  }
  return box;
}

// Bounds in cells of the grid: vertices lie on it, so that these are exact.
struct CellBox {
  QuantizedVertex min = {65535, 65535, 65535}, max = {0, 0, 0};
  void extend(const QuantizedVertex& p) {
    for (int a = 0; a < 3; ++a) min[a] = std::min(min[a], p[a]), max[a] = std::max(max[a], p[a]);
  }
  void extend(const CellBox& b) {
    for (int a = 0; a < 3; ++a) min[a] = std::min(min[a], b.min[a]), max[a] = std::max(max[a], b.max[a]);
  }
};

CellBox facetCells(const LargeMesh& mesh, uint32_t first, uint32_t count) {
  CellBox box;
  for (uint32_t f = first; f < first + count; ++f) {
    const uint32_t base = mesh.vertex_blocks[f / kMaxIslandFacets];
    for (const uint8_t v : mesh.quantized_facets[f].vertex) box.extend(mesh.quantized_vertices[base + v]);
  }
  return box;
}

// Children come after their parents, so that one backward sweep finds all of them done.
template <class Box, class Node, class LeafBounds>
void computeNodes(MeshArray<Node>& nodes, LeafBounds&& leaf_bounds) {
  for (size_t i = nodes.size(); i-- > 0;) {
    for (int slot = 0; slot < 8; ++slot) {
      const MeshChild child = nodes[i].child[slot];
      Box box;
      if (child != kNoChild && isLeaf(child)) {
        box = leaf_bounds(leafFirst(child), leafCount(child));
      } else if (child != kNoChild) {
        const auto& b = nodes[child].bounds;
        for (int s = 0; s < 8 && nodes[child].child[s] != kNoChild; ++s) {
          box.extend(Box{{b[0][s], b[1][s], b[2][s]}, {b[3][s], b[4][s], b[5][s]}});
        }
      }
      for (int a = 0; a < 3; ++a) nodes[i].bounds[a][slot] = box.min[a], nodes[i].bounds[3 + a][slot] = box.max[a];
    }
  }
}

}  // namespace

Error replaceVertices(LargeMesh& mesh, std::span<const Vec3> vertices) {
  if (vertices.size() != mesh.num_source_vertices) return Error::OutOfRange;
  if (!std::all_of(vertices.begin(), vertices.end(), validPosition)) return Error::InvalidValue;
  placeVertices(mesh, vertices);
  computeNormals(mesh);
  computeEdges(mesh);
  for (MeshIsland& island : mesh.islands) island.bounds = facetBounds(mesh, island.first_facet, island.num_facets);
  computeNodes<Aabb>(mesh.nodes, [&](uint32_t first, uint32_t n) { return facetBounds(mesh, first, n); });
  computeNodes<CellBox>(mesh.quantized_nodes, [&](uint32_t first, uint32_t n) { return facetCells(mesh, first, n); });
  return Error::Ok;
}

}  // namespace pfx
