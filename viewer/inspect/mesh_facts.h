// What is known of a large mesh and of each of its triangles.
#pragma once

#include "pfx/base_level/shape/large_mesh.h"
#include "viewer/inspect/body_facts.h"

namespace viewer {

// A large mesh where it stands: the first one of a body.
struct PlacedMesh {
  const pfx::LargeMesh* mesh = nullptr;
  pfx::Transform pose;  // mesh frame to world
};
// Nothing when the body does not exist or has no large mesh.
std::optional<PlacedMesh> meshOfBody(const pfx::World& world, uint32_t body);

// The triangle that a ray (m, world) meets first on the mesh of the body, whichever side it comes from.
struct Ray {
  pfx::Vec3 origin, direction;  // direction: with its length
};
std::optional<uint32_t> pickTriangle(const PlacedMesh& placed, const Ray& ray);

// Triangles of a large mesh that hold the contact points of a pair, ascending; empty for other shapes.
std::vector<uint32_t> touchedTriangles(const pfx::World& world, const pfx::Pair& pair);

// Children to take from the root down to the leaf that holds a facet; empty for a mesh without hierarchy.
struct BvhStep {
  uint32_t node, child;
};
std::vector<BvhStep> bvhPath(const pfx::LargeMesh& mesh, uint32_t facet);

// Size, storage and bounds, and a list of the triangles that carry "contacts".
FactSheet meshFacts(const pfx::World& world, uint32_t body);
// Of a facet of the mesh: where it is, what lies across its edges, and a list of "contacts" on it.
FactSheet triangleFacts(const pfx::World& world, uint32_t body, uint32_t facet);

}  // namespace viewer
