// Narrow phase of two bodies: every shape of one against every shape of the other that may touch it.
#pragma once

#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/collidable.h"

namespace pfx {

struct BodyPair {
  const Collidable &a, &b;
  const Transform &pose_a, &pose_b;  // body to world
  float margin;                      // m, contacts are made for gaps up to this
};

struct FoundManifolds {
  Vector<ContactManifold>& manifolds;
  bool rolls = false;  // a round surface touches
  bool leans = false;  // a mesh has a contact with a normal that is not that of its facet
};

// Appends the manifolds of the pair; `cache` is used where both bodies have one shape.
void collideBodies(const BodyPair& pair, PairCache& cache, MeshContactScratch& scratch, FoundManifolds& out);

bool hasMesh(const Collidable& collidable);

}  // namespace pfx
