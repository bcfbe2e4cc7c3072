// The fields of meshes and shapes, for any archive (fields.h).
#pragma once

#include "pfx/base_level/shape/mesh_check.h"
#include "pfx/base_level/shape/shape.h"
#include "pfx/util/serialize/fields.h"

namespace pfx::serial {

// Entries of long lists: numbers only.
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

template <class A>
void io(A& a, ConvexMesh& m) {
  field(a, "vertices", m.vertices), field(a, "planes", m.planes), field(a, "faces", m.faces),
      field(a, "face-vertices", m.face_vertices), field(a, "edges", m.edges);
  field(a, "bounds", m.bounds), field(a, "centroid", m.centroid), field(a, "inner-radius", m.inner_radius),
      field(a, "outer-radius", m.outer_radius), field(a, "volume", m.volume);
  field(a, "unit-inertia", m.unit_inertia);
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

template <class A>
void io(A& a, LargeMesh& m) {
  enumField(a, "type", m.type, LargeMeshType::QuantizedBvh);
  field(a, "bounds", m.bounds), field(a, "surface-bounds", m.surface_bounds),
      field(a, "max-thickness", m.max_thickness), field(a, "num-source-vertices", m.num_source_vertices);
  field(a, "islands", m.islands), field(a, "neighbors", m.neighbors), field(a, "source", m.source),
      field(a, "user-data", m.user_data);
  field(a, "vertices", m.vertices), field(a, "triangles", m.triangles), field(a, "facets", m.facets),
      field(a, "nodes", m.nodes), field(a, "grid-scale", m.grid_scale);
  field(a, "quantized-vertices", m.quantized_vertices), field(a, "vertex-source", m.vertex_source),
      field(a, "vertex-blocks", m.vertex_blocks), field(a, "quantized-facets", m.quantized_facets);
  field(a, "quantized-nodes", m.quantized_nodes);
  if constexpr (A::kReads) a.require(isConsistent(m), "an index of a large mesh points at nothing");
}

template <class A>
void io(A& a, Sphere& s) {
  field(a, "radius", s.radius);
}
template <class A>
void io(A& a, Box& b) {
  field(a, "half-extent", b.half_extent);
}
template <class A>
void io(A& a, Capsule& c) {
  field(a, "half-length", c.half_length), field(a, "radius", c.radius);
}
template <class A>
void io(A& a, Cylinder& c) {
  field(a, "half-length", c.half_length), field(a, "radius", c.radius);
}

// Shapes name meshes by their number in a table, which has numberOf(mesh) (kNoMesh: it is not there) and
// find(number, mesh), false when there is none of that number.
inline constexpr uint32_t kNoMesh = 0xffffffffu;

template <class A, class Mesh, class MeshTable>
void ioGeometry(A& a, const Mesh*& mesh, MeshTable& meshes) {
  uint32_t number = kNoMesh;
  if constexpr (!A::kReads) {
    number = meshes.numberOf(mesh);
    a.require(number != kNoMesh, "a shape uses a mesh that is not there");
  }
  field(a, "mesh", number);
  if constexpr (A::kReads) a.require(meshes.find(number, mesh), "a shape uses a mesh that is not there");
}
template <class A, class G, class MeshTable>
void ioGeometry(A& a, G& geometry, MeshTable&) {
  io(a, geometry);
}

inline Geometry emptyGeometry(uint8_t type) {
  switch (static_cast<ShapeType>(type)) {
    case ShapeType::Sphere:
      return Sphere{};
    case ShapeType::Box:
      return Box{};
    case ShapeType::Capsule:
      return Capsule{};
    case ShapeType::Cylinder:
      return Cylinder{};
    case ShapeType::ConvexMesh:
      return static_cast<const ConvexMesh*>(nullptr);
    case ShapeType::LargeMesh:
      break;
  }
  return static_cast<const LargeMesh*>(nullptr);
}

template <class A, class MeshTable>
void ioShape(A& a, Shape& s, MeshTable& meshes) {
  auto type = static_cast<uint8_t>(s.geometry.index());
  field(a, "type", type);
  if constexpr (A::kReads) {
    a.require(type < kNumShapeTypes, "a shape is of an unknown kind");
    s.geometry = emptyGeometry(type);
  }
  std::visit([&](auto& g) { ioGeometry(a, g, meshes); }, s.geometry);
  field(a, "offset", s.offset);
}

}  // namespace pfx::serial
