// A concave triangle mesh: islands of neighbouring facets, optionally under a bounding volume hierarchy.
//
// Plain data in arrays, so that a mesh can be moved, copied and written to a file as it is. util/mesh_builder makes it.
// One order rules everything: facets lie in the order of the leaves of the hierarchy, an island is a run of at most
// 64 of them, a leaf a run of at most 4. "Facet" is an index in that order, "source" the triangle it was built from.
//
// Four ways to store it (LargeMeshType):
//   expanded    - vertices as floats in one list; what a contact needs of a facet in 32 bytes;
//   quantized   - vertices on a grid of 65536 cells a side, listed once per 64 facets so that 8 bits index them;
//                 facets in 18 bytes. A vertex decodes to the same float wherever it is used: no cracks;
//   array       - islands are searched one after the other;
//   hierarchy   - nodes of eight children each, tested four or eight at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pfx/base_level/shape/aabb.h"

namespace pfx {

enum class LargeMeshType : uint8_t { ExpandedArray, QuantizedArray, ExpandedBvh, QuantizedBvh };

constexpr bool isQuantized(LargeMeshType t) {
  return t == LargeMeshType::QuantizedArray || t == LargeMeshType::QuantizedBvh;
}
constexpr bool hasBvh(LargeMeshType t) { return t == LargeMeshType::ExpandedBvh || t == LargeMeshType::QuantizedBvh; }

// What lies across an edge. Open: nothing, or several facets, or one that faces the other way.
enum class EdgeKind : uint8_t { Flat, Convex, Concave, Open };

inline constexpr uint32_t kMaxIslandFacets = 64;
inline constexpr uint32_t kMaxLeafFacets = 4;
inline constexpr uint32_t kNoFacet = 0xffffffffu;
inline constexpr float kDefaultThickness = 0.025f;  // m
// Edges whose |sin(angle / 2)| is below this are flat (about 0.06 degrees between the normals).
inline constexpr float kFlatTilt = 5e-4f;

struct MeshIsland {
  uint32_t first_facet = 0;
  uint32_t num_facets = 0;  // 1 .. 64
  Aabb bounds;              // m, of its vertices
};

struct MeshVertex {
  Vec3 position;    // m
  uint32_t source;  // index in the vertices that the mesh was built from
};
static_assert(sizeof(MeshVertex) == 16);

using MeshIndices = std::array<uint32_t, 3>;  // counter-clockwise seen from the front

// Edge k of a facet runs from its vertex k to vertex k + 1.
struct MeshFacet {
  Vec3 normal;                      // unit, front side
  std::array<float, 3> tilt;        // sin(phi / 2) per edge, phi the angle from this normal to the neighbour's; > 0: convex
  float thickness;                  // m, the facet is solid that far behind its front
  std::array<EdgeKind, 3> kind;
  uint8_t reserved = 0;
};

struct QuantizedFacet {
  std::array<int16_t, 3> normal;   // unit / 32767
  std::array<int16_t, 3> tilt;     // sin(phi / 2) / 32767
  uint16_t thickness;              // of LargeMesh::max_thickness / 65535
  std::array<uint8_t, 3> vertex;   // in the vertex block of the facet
  uint8_t kinds;                   // two bits per edge
};
static_assert(sizeof(QuantizedFacet) == 18);

using QuantizedVertex = std::array<uint16_t, 3>;

// A child of a node: a leaf (bit 31: run of facets) or another node.
using MeshChild = uint32_t;
inline constexpr MeshChild kNoChild = 0xffffffffu;
constexpr MeshChild leafChild(uint32_t first, uint32_t count) { return 0x80000000u | (count - 1) << 29 | first; }
constexpr bool isLeaf(MeshChild c) { return (c & 0x80000000u) != 0; }
constexpr uint32_t leafFirst(MeshChild c) { return c & 0x1fffffffu; }
constexpr uint32_t leafCount(MeshChild c) { return (c >> 29 & 3u) + 1; }
inline constexpr uint32_t kMaxFacets = 0x1fffffffu;

// Bounds as rows of eight: min x, y, z, max x, y, z. Unused children come last and are kNoChild.
struct alignas(64) MeshNode {
  float bounds[6][8];
  MeshChild child[8];
};
struct alignas(64) QuantizedMeshNode {
  uint16_t bounds[6][8];
  MeshChild child[8];
};

// The arrays of a mesh; their memory comes from where the mesh was copied to, by default from the heap.
template <class T>
using MeshArray = std::pmr::vector<T>;

struct LargeMesh {
  LargeMeshType type = LargeMeshType::ExpandedBvh;
  Aabb bounds;                 // m, of all that can touch: vertices grown by the largest thickness
  Aabb surface_bounds;         // m, of the vertices; the grid of a quantized mesh spans it
  float max_thickness = 0.0f;  // m
  uint32_t num_source_vertices = 0;

  MeshArray<MeshIsland> islands;
  MeshArray<MeshIndices> neighbors;  // (n_facets) neighbour << 2 | its edge, across edge k; kNoFacet: none
  MeshArray<uint32_t> source;        // (n_facets) triangle that the facet was built from
  MeshArray<uint32_t> user_data;     // (n_facets), or empty: zero for all

  MeshArray<MeshVertex> vertices;    // expanded
  MeshArray<MeshIndices> triangles;  // expanded: (n_facets) into vertices
  MeshArray<MeshFacet> facets;       // expanded: (n_facets)
  MeshArray<MeshNode> nodes;         // expanded with hierarchy; the first is the root

  Vec3 grid_scale = Vec3::Zero();                  // quantized: m per cell
  MeshArray<QuantizedVertex> quantized_vertices;
  MeshArray<uint32_t> vertex_source;             // quantized: (n_vertices) index in the source vertices
  MeshArray<uint32_t> vertex_blocks;             // quantized: (n_facets / 64, rounded up) first vertex of the block
  MeshArray<QuantizedFacet> quantized_facets;    // quantized: (n_facets)
  MeshArray<QuantizedMeshNode> quantized_nodes;  // quantized with hierarchy

  uint32_t numFacets() const { return static_cast<uint32_t>(source.size()); }
};

// All that a contact needs to know of a facet, decoded. Mesh frame, m.
struct MeshTriangle {
  std::array<Vec3, 3> vertex;
  Vec3 normal;
  std::array<float, 3> tilt;
  std::array<EdgeKind, 3> kind;
  float thickness;
};

// Position of a vertex of the grid. The same expression everywhere, so that bounds and vertices agree to the bit.
inline float gridToFloat(float origin, float scale, uint16_t cell) {
  return origin + scale * static_cast<float>(cell);
}
inline Vec3 gridToFloat(const LargeMesh& mesh, const QuantizedVertex& q) {
  const Vec3& o = mesh.surface_bounds.min;
  const Vec3& s = mesh.grid_scale;
  return {gridToFloat(o.x(), s.x(), q[0]), gridToFloat(o.y(), s.y(), q[1]), gridToFloat(o.z(), s.z(), q[2])};
}

// Corners of a facet, m, mesh frame.
std::array<Vec3, 3> facetVertices(const LargeMesh& mesh, uint32_t facet);

MeshTriangle meshTriangle(const LargeMesh& mesh, uint32_t facet);

// Index of the island that holds the facet.
uint32_t islandOf(const LargeMesh& mesh, uint32_t facet);

inline uint32_t userData(const LargeMesh& mesh, uint32_t facet) {
  return mesh.user_data.empty() ? 0 : mesh.user_data[facet];
}

// Memory of all arrays, bytes.
size_t memoryBytes(const LargeMesh& mesh);

}  // namespace pfx
