// Writes the arrays of a low-level application to a file, and reads them back on any platform.
//
// The application gives its memory through callbacks and keeps it; meshes that are read allocate what they
// need, and the application destroys them. All that points from record to record is written as a number:
// shapes of a collidable, meshes of a shape.
#pragma once

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/util/serialize/document.h"

namespace pfx {

// Writing: what is written. Reading: the room that there is; spans may be longer than what is loaded.
struct SceneArrays {
  std::span<ConvexMesh> convex_meshes;
  std::span<LargeMesh> large_meshes;
  std::span<Shape> shapes;  // of collidables with several; meshes must be among the above
  std::span<RigidState> states;
  std::span<RigidBody> bodies;
  std::span<Collidable> collidables;  // several shapes must be a run of `shapes`
  std::span<Joint> joints;
  std::span<Pair> joint_pairs;    // contact_id is the index of a joint; bodies are indices of states
  std::span<Pair> contact_pairs;  // contact_id is the index of a manifold, or kNoContact
  std::span<ContactManifold> manifolds;
};

// How many records of each array were written or loaded, or are in a file.
struct SceneCounts {
  uint32_t convex_meshes = 0, large_meshes = 0, shapes = 0, states = 0, bodies = 0, collidables = 0,
           joints = 0, joint_pairs = 0, contact_pairs = 0, manifolds = 0;
};

struct SerializeCallbacks {
  std::function<void(SceneArrays&)> init;        // required; first
  std::function<void(const SceneCounts&)> term;  // last, whenever init was called; zeros after a failure
  std::function<bool(const SceneCounts& in_file, SceneArrays&)> resize;  // reading: larger arrays, or false
  std::function<void(uint32_t progress, uint32_t max)> update;           // reading: rises, ends at max
  std::function<void(const SerializeFailure&)> error;
};

// Both leave the file open (binary or text mode), behind what they wrote or read. A file that is damaged
// changes no array. Values that are NaN, masses and sizes that are negative or not finite, orientations that
// are not of length 1 and indices of nothing are SerializeError::Data, when writing as well.
SerializeError serializeWrite(std::FILE* file, const SerializeCallbacks& callbacks);
SerializeError serializeRead(std::FILE* file, const SerializeCallbacks& callbacks);

}  // namespace pfx
