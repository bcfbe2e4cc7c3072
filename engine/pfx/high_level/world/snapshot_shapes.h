// Snapshots: the bytes of meshes and shapes.
#pragma once

#include <algorithm>
#include <deque>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/shape/shape.h"
#include "pfx/high_level/world/snapshot_archive.h"

namespace pfx::snapshot_format {

template <class A>
void io(A& a, Plane& p) {
  io(a, p.normal), io(a, p.offset);
}
template <class A>
void io(A& a, PolytopeFace& f) {
  io(a, f.first), io(a, f.count);
}
template <class A>
void io(A& a, PolytopeEdge& e) {
  io(a, e.v0), io(a, e.v1), io(a, e.left), io(a, e.right);
}

inline bool isConsistent(const ConvexMesh& m) {
  const auto face_ok = [&](const PolytopeFace& f) {
    return f.count >= 3 && f.count <= kMaxFaceVertices && uint64_t(f.first) + f.count <= m.face_vertices.size();
  };
  const auto edge_ok = [&](const PolytopeEdge& e) {
    return std::max(e.v0, e.v1) < m.vertices.size() && std::max(e.left, e.right) < m.faces.size();
  };
  return m.vertices.size() >= 4 && m.faces.size() >= 4 && m.planes.size() == m.faces.size() &&
         std::ranges::all_of(m.faces, face_ok) && std::ranges::all_of(m.edges, edge_ok) &&
         std::ranges::all_of(m.face_vertices, [&](uint16_t v) { return v < m.vertices.size(); });
}

template <class A>
void io(A& a, ConvexMesh& m) {
  io(a, m.vertices), io(a, m.planes), io(a, m.faces), io(a, m.face_vertices), io(a, m.edges);
  io(a, m.bounds), io(a, m.centroid), io(a, m.inner_radius), io(a, m.outer_radius), io(a, m.volume);
  io(a, m.unit_inertia);
  if constexpr (A::kReads) {
    a.require(isConsistent(m), "a convex mesh is not one");
    std::vector<Vec3> normals;
    for (const Plane& p : m.planes) normals.push_back(p.normal);
    m.packed_vertices = packFours(m.vertices);
    m.packed_normals = packFours(normals);
  }
}

template <class A>
void io(A& a, MeshIsland& i) {
  io(a, i.first_facet), io(a, i.num_facets), io(a, i.bounds);
}
template <class A>
void io(A& a, MeshVertex& v) {
  io(a, v.position), io(a, v.source);
}
template <class A>
void io(A& a, EdgeKind& k) {
  ioEnum(a, k, EdgeKind::Open);
}
template <class A>
void io(A& a, MeshFacet& f) {
  io(a, f.normal), io(a, f.tilt), io(a, f.thickness), io(a, f.kind), io(a, f.reserved);
}
template <class A>
void io(A& a, QuantizedFacet& f) {
  io(a, f.normal), io(a, f.tilt), io(a, f.thickness), io(a, f.vertex), io(a, f.kinds);
}
template <class A>
void io(A& a, MeshNode& n) {
  io(a, n.bounds), io(a, n.child);
}
template <class A>
void io(A& a, QuantizedMeshNode& n) {
  io(a, n.bounds), io(a, n.child);
}

// Children come after their parents, so that no path runs in a circle.
template <class Node>
bool childrenAreThere(const MeshArray<Node>& nodes, uint32_t facets) {
  for (size_t i = 0; i < nodes.size(); ++i)
    for (MeshChild c : nodes[i].child) {
      if (c == kNoChild) continue;
      if (isLeaf(c) ? uint64_t(leafFirst(c)) + leafCount(c) > facets : c <= i || c >= nodes.size()) return false;
    }
  return true;
}

// Whether all indices of the mesh point at something.
inline bool isConsistent(const LargeMesh& m) {
  const uint32_t n = m.numFacets();
  const bool quantized = isQuantized(m.type);
  const size_t records = quantized ? m.quantized_facets.size() : m.facets.size();
  if (n == 0 || records != n || m.neighbors.size() != n || (!m.user_data.empty() && m.user_data.size() != n)) return false;
  for (const MeshIndices& sides : m.neighbors)
    for (uint32_t s : sides)
      if (s != kNoFacet && (s >> 2) >= n) return false;
  for (const MeshIsland& i : m.islands)
    if (i.num_facets == 0 || i.num_facets > kMaxIslandFacets || uint64_t(i.first_facet) + i.num_facets > n) return false;
  const bool has_nodes = quantized ? !m.quantized_nodes.empty() : !m.nodes.empty();
  if (m.islands.empty() || has_nodes != hasBvh(m.type)) return false;
  if (!childrenAreThere(m.nodes, n) || !childrenAreThere(m.quantized_nodes, n)) return false;
  for (const MeshVertex& v : m.vertices)
    if (v.source >= m.num_source_vertices) return false;
  for (uint32_t v : m.vertex_source)
    if (v >= m.num_source_vertices) return false;
  if (!quantized) {
    return m.triangles.size() == n && std::ranges::all_of(m.triangles, [&](const MeshIndices& t) {
             return std::max({t[0], t[1], t[2]}) < m.vertices.size();
           });
  }
  if (m.vertex_blocks.size() < (n + 63) / 64 || m.vertex_source.size() != m.quantized_vertices.size()) return false;
  for (uint32_t f = 0; f < n; ++f)
    for (uint8_t v : m.quantized_facets[f].vertex)
      if (uint64_t(m.vertex_blocks[f / 64]) + v >= m.quantized_vertices.size()) return false;
  return true;
}

template <class A>
void io(A& a, LargeMesh& m) {
  ioEnum(a, m.type, LargeMeshType::QuantizedBvh);
  io(a, m.bounds), io(a, m.surface_bounds), io(a, m.max_thickness), io(a, m.num_source_vertices);
  io(a, m.islands), io(a, m.neighbors), io(a, m.source), io(a, m.user_data);
  io(a, m.vertices), io(a, m.triangles), io(a, m.facets), io(a, m.nodes), io(a, m.grid_scale);
  io(a, m.quantized_vertices), io(a, m.vertex_source), io(a, m.vertex_blocks), io(a, m.quantized_facets);
  io(a, m.quantized_nodes);
  if constexpr (A::kReads) a.require(isConsistent(m), "an index of a large mesh points at nothing");
}

template <class A>
void io(A& a, Sphere& s) {
  io(a, s.radius);
}
template <class A>
void io(A& a, Box& b) {
  io(a, b.half_extent);
}
template <class A>
void io(A& a, Capsule& c) {
  io(a, c.half_length), io(a, c.radius);
}
template <class A>
void io(A& a, Cylinder& c) {
  io(a, c.half_length), io(a, c.radius);
}

// Meshes of a world; shapes name them by their number.
struct MeshTable {
  std::deque<ConvexMesh>& convex;
  std::deque<LargeMesh>& large;
};

template <class A, class Mesh>
void ioMesh(A& a, const Mesh*& mesh, std::deque<Mesh>& kept) {
  uint32_t number = 0;
  if constexpr (!A::kReads)
    number = static_cast<uint32_t>(
        std::find_if(kept.begin(), kept.end(), [&](const Mesh& m) { return &m == mesh; }) - kept.begin());
  io(a, number);
  if constexpr (A::kReads) {
    a.require(number < kept.size(), "a shape uses a mesh that is not there");
    mesh = &kept[number];
  }
}
template <class A>
void ioGeometry(A& a, const ConvexMesh*& mesh, MeshTable& t) {
  ioMesh(a, mesh, t.convex);
}
template <class A>
void ioGeometry(A& a, const LargeMesh*& mesh, MeshTable& t) {
  ioMesh(a, mesh, t.large);
}
template <class A, class G>
void ioGeometry(A& a, G& geometry, MeshTable&) {
  io(a, geometry);
}

inline Geometry emptyGeometry(uint8_t type) {
  switch (static_cast<ShapeType>(type)) {
    case ShapeType::Sphere: return Sphere{};
    case ShapeType::Box: return Box{};
    case ShapeType::Capsule: return Capsule{};
    case ShapeType::Cylinder: return Cylinder{};
    case ShapeType::ConvexMesh: return static_cast<const ConvexMesh*>(nullptr);
    case ShapeType::LargeMesh: break;
  }
  return static_cast<const LargeMesh*>(nullptr);
}

template <class A>
void io(A& a, Shape& s, MeshTable& meshes) {
  auto type = static_cast<uint8_t>(s.geometry.index());
  io(a, type);
  if constexpr (A::kReads) {
    a.require(type < kNumShapeTypes, "a shape is of an unknown kind");
    s.geometry = emptyGeometry(type);
  }
  std::visit([&](auto& g) { ioGeometry(a, g, meshes); }, s.geometry);
  io(a, s.offset);
}

}  // namespace pfx::snapshot_format
