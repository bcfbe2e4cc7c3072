// Bodies that touch several meshes at once: contacts that only one of the meshes would have are taken out.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/collision/mesh_seam.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/low_level/collision/contact_store.h"

namespace pfx {

// A pair of which one body has a mesh.
struct MeshPair {
  uint32_t body;  // that touches the mesh
  uint32_t mesh_body;
  uint32_t pair;
  bool leans;  // a normal of the pair is not that of its facet: it comes from an edge or a vertex

  friend bool operator<(const MeshPair& a, const MeshPair& b) {
    return a.body != b.body ? a.body < b.body : a.pair < b.pair;
  }
};

struct SeamInput {
  std::span<const RigidState> states;       // by body
  std::span<const Collidable> collidables;  // by body
  std::span<const Pair> pairs;
};

// Drops contact points with a normal that the meshes under a body do not have together (see mesh_seam.h).
// Sorts `found`, the mesh pairs of a step in any order; the result does not depend on it.
void dropGhostContacts(const SeamInput& input, Vector<MeshPair>& found, ContactStore& contacts);

// The pairs of one body among sorted ones.
std::span<const MeshPair> meshPairsOf(std::span<const MeshPair> sorted, uint32_t body);

// Adds what the meshes of a body at `pose` say of a normal at a point; both in the world.
void judge(const Collidable& collidable, const Transform& pose, const SurfacePoint& at, SeamVerdict& verdict);

}  // namespace pfx
