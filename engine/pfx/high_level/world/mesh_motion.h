// Large meshes whose vertices move: how fast their surface is, where contacts on it go, what it lifts.
#pragma once

#include <span>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/mesh_body.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

// A mesh of a world that was deformed at least once.
struct MeshMotion {
  uint32_t mesh = 0;           // in World::Impl::large_meshes
  Vector<Vec3> now = {};  // m, mesh frame, by vertex that the mesh was built from
  bool is_moving = false;      // the next step is to know of the velocities
  float fastest = 0.0f;        // m/s
  float farthest = 0.0f;       // m, of the last deformation
  Vector<Vec3> before = {};    // m, likewise
  Vector<Vec3> velocity = {};  // m/s
};

// What the solver needs to know of a contact on such a mesh.
struct MovingSurface {
  uint32_t body;
  Vec3 velocity;  // m/s, world, of the surface itself
};

// The vertices that the corners of a facet were built from.
std::array<uint32_t, 3> facetSources(const LargeMesh& mesh, uint32_t facet);

// A value given by vertex, at barycentric coordinates of a facet.
Vec3 onFacet(std::span<const Vec3> values, const std::array<uint32_t, 3>& sources, const Vec2& barycentric);

// Where the vertices are that a mesh was built from; those without a facet are taken from `others`.
Vector<Vec3> verticesOf(const LargeMesh& mesh, std::span<const Vec3> others);

// Starts a deformation to `vertices` within dt seconds; 0: a jump without velocity.
void beginMotion(MeshMotion& motion, std::span<const Vec3> vertices, float dt);

// Moves the points of a manifold with their triangles. side_a: the mesh is on body A.
struct MeshSide {
  bool side_a;
  Transform mesh;   // mesh frame to world
  Transform offset;  // mesh frame to body
  Transform other;  // pose of the other body
};
void followTriangles(ContactManifold& manifold, const MeshMotion& motion, const LargeMesh& mesh, const MeshSide& side);

// How a convex shape has to be moved (m, mesh frame) so that the deformation has not pushed it any deeper into the
// facet that it lies over. Facets that had it behind them before do not count.
Vec3 liftOf(const MeshBody& body, const MeshMotion& motion, const LargeMesh& mesh);

}  // namespace pfx
