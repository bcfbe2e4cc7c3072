// The convex shape of a mesh contact, seen from the mesh.
#pragma once

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

// A convex polygon whose vertices know what they are. One vertex: a point; two: a segment.
struct FeaturePolygon {
  struct Vertex {
    Vec3 p;
    uint32_t feature;
  };
  static constexpr int kMax = kMaxFaceVertices + 8;
  int count = 0;
  Vertex vertices[kMax];

  void add(const Vec3& p, uint32_t feature) {
    if (count < kMax) vertices[count++] = {p, feature};
  }
};

// Vertices and faces lie in buffers of the caller.
struct MeshBody {
  enum class Kind : uint8_t { Point, Segment, Cylinder, Polytope };

  Kind kind = Kind::Point;
  float radius = 0.0f;          // m, rounding of point and segment
  Vec3 center = Vec3::Zero();   // m, mesh frame, like all that follows
  Aabb bounds;                  // rounding included
  float size = 0.0f;            // m, of a ball around the centre that holds the body

  Vec3 axis = Vec3::UnitX();        // segment, cylinder: unit
  float half_length = 0.0f;         // segment, cylinder
  float cylinder_radius = 0.0f;

  Polytope polytope;                // Polytope: vertices, planes and topology
  ConvexCore core;                  // Cylinder: for the distance to a triangle ...
  RelativePose pose;                // ... and where it is

  Vec3 end(int i) const { return center + (i == 0 ? -half_length : half_length) * axis; }

  // Least value of direction . x over the body; the direction is unit.
  float lowest(const Vec3& direction) const;

  // The face, segment or point that lies farthest along the unit direction, without the rounding.
  void supportingFeature(const Vec3& direction, FeaturePolygon& polygon) const;
};

// Buffers that the vertices and planes of a body are written to.
struct MeshBodyBuffers {
  Vector<Vec3>& vertices;
  Vector<Plane>& planes;
};

// The body of a convex geometry whose frame lies at `pose` in the frame of the mesh.
MeshBody makeMeshBody(const Geometry& geometry, const Transform& pose, MeshBodyBuffers buffers);

// Names of vertices: bit 31 says that the body's own vertex, not the mesh, gave the point its name.
constexpr uint32_t bodyFeature(uint32_t vertex) { return 0x80000000u | vertex; }

}  // namespace pfx
