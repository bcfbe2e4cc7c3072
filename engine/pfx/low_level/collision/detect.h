// Collision detection of all pairs: manifolds with the impulses that they inherit.
//
// A pair that has hardly moved since its manifold was found keeps it and only has its distances measured
// again. This loses nothing: a point left out was farther away than the margin, and the motion allowed is
// half of that. Where a round surface touches it has to have moved hardly at all.
#pragma once

#include <span>

#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/low_level/collision/contact_store.h"
#include "pfx/low_level/collision/seams.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

// How far ahead of touching a body makes contacts (m).
struct ContactReach {
  float resting = 0.0f;  // always; a pair uses the smaller of the two
  float travel = 0.0f;   // at most, for what its surface moves in the step
  float surface = 0.0f;  // of that, what the surface moves on its own: a mesh that changes its shape
};

struct DetectInput {
  std::span<const RigidState> states;       // by body
  std::span<const Collidable> collidables;  // by body
  std::span<const ContactReach> reach;      // by body
  std::span<const Pair> pairs;              // contact_id names the contact
  float dt = 0.0f;                          // s, of the step
};

class CollisionDetector {
 public:
  // Updates the contacts of all pairs. The result does not depend on the number of workers. Error::OutOfRange for spans of
  // different length, and for a pair with a body or contact that does not exist; nothing is done then.
  Error detect(const DetectInput& input, ContactStore& contacts, TaskManager& tasks);

  uint32_t numRecycled() const { return num_recycled_; }  // pairs of the last call that kept their manifolds

  // Pairs of the last call of which one body has a mesh, sorted by the other body.
  std::span<const MeshPair> meshPairs() const { return mesh_pairs_; }

 private:
  // Manifolds that did not fit the block of their contact.
  struct Pending {
    uint32_t pair, first, count;
  };
  struct Scratch {
    MeshContactScratch mesh;
    Vector<ContactManifold> found;    // of the pair at hand
    Vector<ContactManifold> storage;  // of pending pairs
    Vector<Pending> pending;
    Vector<MeshPair> mesh_pairs;
    uint32_t recycled = 0;
  };

  void detectPair(const DetectInput& input, uint32_t pair, ContactStore& contacts, Scratch& scratch) const;
  static void noteMesh(const DetectInput& input, uint32_t pair, bool leans, Scratch& scratch);
  void prepareScratch(uint32_t num_workers);
  void assignPending(const DetectInput& input, ContactStore& contacts);

  Vector<Scratch> scratch_;                      // by worker
  Vector<std::pair<uint32_t, uint32_t>> order_;  // (pair, worker) of what is pending
  Vector<MeshPair> mesh_pairs_;                  // of the last call
  uint32_t num_recycled_ = 0;
};

}  // namespace pfx
