// Contacts of a convex shape with a large mesh.
//
// Every facet near the shape is asked for the normal along which the two can be parted with least motion - among the
// normals that the surface really has there. A facet offers its own normal; a convex edge the arc between its two
// facets; a convex vertex the cone between its edges; flat and concave edges nothing. A box that slides over a plane
// made of triangles therefore meets the plane, never the edges between them.
// Source of the idea: G. van den Bergen, Ghost collisions, in Game Physics Pearls, 2010; S. McMillan et al., Smooth mesh
// contacts with GJK, in Game Physics Pearls.
//
// Facets have one front. A shape whose centre is more than the facet's thickness behind it is beyond its concern.
// Points with (nearly) the same normal form one manifold of up to four, by the four-point rule, whatever the number of
// facets they come from.
#pragma once

#include <cstdint>

#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/shape/polytope.h"

namespace pfx {

// A contact found on a facet: mesh frame, normal from the mesh to the body.
struct MeshContact {
  Vec3 point_mesh;   // m
  Vec3 point_body;   // m
  float distance;    // m along the normal of its cluster
  uint32_t facet;
  uint32_t feature;
};

// Contacts of one normal, while they are collected: the deepest and the outermost in eight directions.
struct MeshCluster {
  static constexpr int kDirections = 8;
  Vec3 normal;
  bool primary = false;   // some facet met the shape along its best normal, not only as a neighbour
  bool touching = false;  // some point has distance <= 0
  int count = 0;          // candidates kept: 0 or 1 + kDirections
  MeshContact kept[1 + kDirections];
  float reach[kDirections];
};

// Buffers that the search fills again and again; nothing is allocated once they have grown.
struct MeshContactScratch {
  Vector<uint32_t> facets;  // near the body
  Vector<MeshCluster> clusters;
  Vector<Vec3> vertices;         // of the body, mesh frame
  Vector<Plane> planes;          // of the body, mesh frame
  Vector<LocalContact> parts;    // of compounds, frame of body A
};

// Appends the manifolds of a pair of which one shape is a large mesh and the other is convex: normals in world axes from
// A to B, points as collideShapes() gives them, with triangle and barycentric coordinates. Returns how many it
// appended; zero also when neither or both shapes are meshes, one is missing, or a pose is not finite. `input.cache` is not used.
int collideMesh(const CollideInput& input, MeshContactScratch& scratch, Vector<ContactManifold>& manifolds);

}  // namespace pfx
