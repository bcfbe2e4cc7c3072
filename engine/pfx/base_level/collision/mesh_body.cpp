// Supports and features of the convex body of a mesh contact.
#include "pfx/base_level/collision/mesh_body.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_clipping.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/base_level/shape/convex_mesh.h"

namespace pfx {
namespace {

// Moves a polytope into the frame of the mesh; the topology stays where it is.
void placePolytope(const Polytope& local, MeshBody& body, MeshBodyBuffers buffers) {
  body.kind = MeshBody::Kind::Polytope;
  buffers.vertices.clear();
  buffers.planes.clear();
  for (const Vec3& v : local.vertices) buffers.vertices.push_back(body.pose.toA(v));
  for (const Plane& p : local.planes) {
    const Vec3 n = body.pose.rotation * p.normal;
    buffers.planes.push_back({n, p.offset + n.dot(body.pose.position)});
  }
  body.polytope = local;
  body.polytope.vertices = buffers.vertices;
  body.polytope.planes = buffers.planes;
  body.polytope.packed_vertices = {};  // they lie where the shape lies in its own frame
  body.polytope.packed_normals = {};
  body.center = body.pose.toA(local.center);
  for (const Vec3& v : buffers.vertices) body.size = std::max(body.size, (v - body.center).norm());
}

void place(const Sphere& s, MeshBody& body, MeshBodyBuffers) {
  body.radius = s.radius;
  body.size = s.radius;
}
void place(const Capsule& c, MeshBody& body, MeshBodyBuffers) {
  body.kind = MeshBody::Kind::Segment;
  body.radius = c.radius;
  body.half_length = c.half_length;
  body.size = c.half_length + c.radius;
}
void place(const Cylinder& c, MeshBody& body, MeshBodyBuffers) {
  body.kind = MeshBody::Kind::Cylinder;
  body.half_length = c.half_length;
  body.cylinder_radius = c.radius;
  body.core = cylinderCore(c);
  body.size = std::sqrt(c.half_length * c.half_length + c.radius * c.radius);
}
void place(const Box& b, MeshBody& body, MeshBodyBuffers buffers) {
  const BoxPolytope box(b.half_extent);
  placePolytope(box.view(), body, buffers);
}
void place(const ConvexMesh* mesh, MeshBody& body, MeshBodyBuffers buffers) {
  placePolytope(mesh->view(), body, buffers);
}
void place(const LargeMesh*, MeshBody&, MeshBodyBuffers) {}

// The rim of the cap that looks along +-axis: eight points, one of them the farthest along `direction`.
void addCap(const MeshBody& body, const Vec3& direction, bool positive, FeaturePolygon& polygon) {
  const Vec3 cap = positive ? body.axis : Vec3(-body.axis);
  Vec3 u = direction - direction.dot(cap) * cap;
  if (u.norm() > 1e-3f) {
    u.normalize();
  } else {
    u = body.pose.rotation.col(1);
  }
  const Vec3 w = cap.cross(u);
  constexpr float h = 0.70710678f;
  constexpr float kCircle[8][2] = {{1, 0}, {h, h}, {0, 1}, {-h, h}, {-1, 0}, {-h, -h}, {0, -1}, {h, -h}};
  const Vec3 center = body.center + body.half_length * cap;
  for (uint32_t i = 0; i < 8; ++i) {
    polygon.add(center + body.cylinder_radius * (kCircle[i][0] * u + kCircle[i][1] * w),
                bodyFeature(16 + 8 * uint32_t(positive) + i));
  }
}

}  // namespace

float MeshBody::lowest(const Vec3& d) const {
  switch (kind) {
    case Kind::Point: return d.dot(center) - radius;
    case Kind::Segment: return d.dot(center) - half_length * std::abs(d.dot(axis)) - radius;
    case Kind::Cylinder: {
      const float along = d.dot(axis);
      const float across = (d - along * axis).norm();
      return d.dot(center) - half_length * std::abs(along) - cylinder_radius * across;
    }
    case Kind::Polytope: break;
  }
  float least = polytope.vertices[0].dot(d);
  for (const Vec3& v : polytope.vertices) least = std::min(least, v.dot(d));
  return least;
}

void MeshBody::supportingFeature(const Vec3& d, FeaturePolygon& polygon) const {
  polygon.count = 0;
  switch (kind) {
    case Kind::Point: polygon.add(center, bodyFeature(0)); return;
    case Kind::Segment:
      polygon.add(end(0), bodyFeature(0));
      polygon.add(end(1), bodyFeature(1));
      return;
    case Kind::Cylinder: {
      const float along = d.dot(axis);
      if (std::abs(along) > 0.7f) return addCap(*this, d, along > 0.0f, polygon);
      const Vec3 side = cylinder_radius * (d - along * axis).normalized();
      polygon.add(end(0) + side, bodyFeature(0));
      polygon.add(end(1) + side, bodyFeature(1));
      return;
    }
    case Kind::Polytope: break;
  }
  const uint32_t face = supportingFaceAt(polytope, d, farthestVertex(polytope, d));
  for (const uint16_t v : polytope.face(face)) polygon.add(polytope.vertices[v], bodyFeature(v));
}

MeshBody makeMeshBody(const Geometry& geometry, const Transform& pose, MeshBodyBuffers buffers) {
  MeshBody body;
  body.pose = RelativePose(pose);
  body.center = pose.position;
  body.axis = body.pose.rotation.col(0);
  body.bounds = shapeAabb(geometry, pose);
  std::visit([&](const auto& g) { place(g, body, buffers); }, geometry);
  return body;
}

}  // namespace pfx
