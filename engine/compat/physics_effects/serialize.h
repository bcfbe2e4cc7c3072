// Serialization: the arrays of an application to a text file that reads back on any platform.
#pragma once

#include <cstdio>

#include "contact.h"
#include "joint.h"

namespace sce {
namespace PhysicsEffects {

// Numbers of instances. Writing: how many there are. Reading: how many there is room for, and what was loaded in the end.
struct PfxSerializeCapacity {
  // Of each kind.
  SCE_PFX_NUM_RIGID_BODIES_;  // states, bodies and collidables
  PfxUInt32 numShapes = 0;    // of collidables with several
  PfxUInt32 numConvexMeshes = 0;
  PfxUInt32 numLargeTriMeshes = 0;
  PfxUInt32 numJoints = 0;
  PfxUInt32 numPairs = 0;  // broad-phase pairs with contact ids
  PfxUInt32 numContacts = 0;
};

// Where the instances lie. NULL is an error where the number is not 0.
struct PfxSerializeBuffers {
  // Arrays of as many instances as the numbers say.
  PfxRigidState* states = nullptr;
  PfxRigidBody* bodies = nullptr;
  PfxCollidable* collidables = nullptr;
  PfxShape* shapes = nullptr;  // collidables with several shapes must have theirs here
  PfxConvexMesh* convexMeshes = nullptr;  // shapes may use these meshes and no others
  PfxLargeTriMesh* largeTriMeshes = nullptr;
  PfxJoint* joints = nullptr;
  PfxBroadphasePair* pairs = nullptr;
  PfxContactManifold* contacts = nullptr;
};

// Called first: sets pointers and numbers.
typedef void (*PfxSerializeInitFunc)(PfxSerializeBuffers& buffers, PfxSerializeCapacity& capacity);
// Called at the end, whenever init was called: numbers of what was written or loaded, zeros after a failure.
typedef void (*PfxSerializeTermFunc)(PfxSerializeBuffers& buffers, PfxSerializeCapacity& capacity);
// Called when a file holds more than there is room for: sets larger buffers and returns true, or returns false.
typedef PfxBool (*PfxSerializeResizeFunc)(PfxSerializeBuffers& buffers, PfxSerializeCapacity& capacity,
                                          const PfxSerializeCapacity& capacityLoaded);
// Called while reading: progress rises, and is max at the end.
typedef void (*PfxSerializeUpdateFunc)(PfxUInt32 progress, PfxUInt32 max);
// Called on an error: the tags lead from the outermost group of the file to the place.
typedef void (*PfxSerializeErrorFunc)(PfxInt32 errorCode, const char* const* tags, PfxUInt32 numTags);

// All but init may be NULL; writing calls neither resize nor update.
struct PfxSerializeFuncs {
  // In the order in which they may be called.
  PfxSerializeInitFunc initFunc = nullptr;
  PfxSerializeTermFunc termFunc = nullptr;
  PfxSerializeResizeFunc resizeFunc = nullptr;
  PfxSerializeUpdateFunc updateFunc = nullptr;
  PfxSerializeErrorFunc errorFunc = nullptr;
};

// Write to, and read from, a file that the application has opened; it stays open, behind what was written or read. A
// damaged file changes no array. Meshes that are read take memory from the utility allocator; the application releases
// them. Errors: SCE_PFX_ERR_SERIALIZE_...; SCE_PFX_ERR_INVALID_VALUE: no file or no init function.
PfxInt32 pfxSerializeWrite(std::FILE* file, const PfxSerializeFuncs& funcs);
PfxInt32 pfxSerializeRead(std::FILE* file, const PfxSerializeFuncs& funcs);

// The same with the functions one by one.
inline PfxInt32 pfxSerializeWrite(std::FILE* file, PfxSerializeInitFunc init, PfxSerializeTermFunc term = nullptr,
                                  PfxSerializeErrorFunc error = nullptr) {
  PfxSerializeFuncs funcs;
  funcs.initFunc = init, funcs.termFunc = term, funcs.errorFunc = error;
  return pfxSerializeWrite(file, funcs);
}
inline PfxInt32 pfxSerializeRead(std::FILE* file, PfxSerializeInitFunc init, PfxSerializeTermFunc term = nullptr,
                                 PfxSerializeResizeFunc resize = nullptr, PfxSerializeUpdateFunc update = nullptr,
                                 PfxSerializeErrorFunc error = nullptr) {
  PfxSerializeFuncs funcs;
  funcs.initFunc = init, funcs.termFunc = term, funcs.resizeFunc = resize, funcs.updateFunc = update, funcs.errorFunc = error;
  return pfxSerializeRead(file, funcs);
}

}  // namespace PhysicsEffects
}  // namespace sce
