// External force, broad-phase proxies, pairs, and which pairs are new, kept and gone.
#pragma once

#include "shape.h"
#include "sort.h"

// What pfxUpdateBroadphaseProxies() does with bodies outside of the world; flags.
#define SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION 0x01u    // bodies outside become Fixed
#define SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY 0x02u  // bodies outside get no proxy

// The number of bodies in the arrays; both spellings name one member.
#define SCE_PFX_NUM_RIGID_BODIES_ \
  union {                         \
    PfxUInt32 numRigidBodies = 0; \
    PfxUInt32 numRigidBody;       \
  }

namespace sce {
namespace PhysicsEffects {

// Changes the velocity by force (N) and torque (N m, world axes) over timeStep. Only bodies that are awake and Active or
// OneWay are changed. SCE_PFX_ERR_INVALID_VALUE for a time step that is not positive or values that are not finite.
PfxInt32 pfxApplyExternalForce(PfxRigidState& state, const PfxRigidBody& body, const PfxVector3& extForce,
                               const PfxVector3& extTorque, PfxFloat timeStep);

// One proxy for each body: bounds on a grid of 2^21 cells over the world, body, motion type, filters. Sorted by its key.
typedef PfxSortData32 PfxBroadphaseProxy;
// Two bodies. 0, 1: their ids; then motion, flags, contact or joint id, key.
typedef PfxSortData16 PfxBroadphasePair;
typedef PfxSortData16 PfxConstraintPair;

// Parts of a pair: ids of the two bodies, their motion masks, whether it takes part, and the contact or joint that it names.
inline void pfxSetRigidBodyIdA(PfxBroadphasePair& p, PfxUInt16 id) { p.set16(0, id); }
inline void pfxSetRigidBodyIdB(PfxBroadphasePair& p, PfxUInt16 id) { p.set16(1, id); }
inline void pfxSetMotionMaskA(PfxBroadphasePair& p, PfxUInt8 mask) { p.set8(4, mask); }
inline void pfxSetMotionMaskB(PfxBroadphasePair& p, PfxUInt8 mask) { p.set8(5, mask); }
inline void pfxSetActive(PfxBroadphasePair& p, PfxBool active) { p.set8(6, active ? 1 : 0); }
inline void pfxSetContactId(PfxBroadphasePair& p, PfxUInt32 id) { p.set32(2, id); }
inline void pfxSetConstraintId(PfxBroadphasePair& p, PfxUInt32 id) { p.set32(2, id); }
inline PfxUInt16 pfxGetRigidBodyIdA(const PfxBroadphasePair& p) { return p.get16(0); }
inline PfxUInt16 pfxGetRigidBodyIdB(const PfxBroadphasePair& p) { return p.get16(1); }
inline PfxUInt8 pfxGetMotionMaskA(const PfxBroadphasePair& p) { return p.get8(4); }
inline PfxUInt8 pfxGetMotionMaskB(const PfxBroadphasePair& p) { return p.get8(5); }
inline PfxBool pfxGetActive(const PfxBroadphasePair& p) { return p.get8(6) != 0; }
inline PfxUInt32 pfxGetContactId(const PfxBroadphasePair& p) { return p.get32(2); }
inline PfxUInt32 pfxGetConstraintId(const PfxBroadphasePair& p) { return p.get32(2); }
inline void pfxSetNumConstraints(PfxConstraintPair& p, PfxUInt8 n) { p.set8(7, n); }
inline PfxUInt8 pfxGetNumConstraints(const PfxConstraintPair& p) { return p.get8(7); }
// The older names.
inline void pfxSetObjectIdA(PfxBroadphasePair& p, PfxUInt16 id) { pfxSetRigidBodyIdA(p, id); }
inline void pfxSetObjectIdB(PfxBroadphasePair& p, PfxUInt16 id) { pfxSetRigidBodyIdB(p, id); }
inline PfxUInt16 pfxGetObjectIdA(const PfxBroadphasePair& p) { return pfxGetRigidBodyIdA(p); }
inline PfxUInt16 pfxGetObjectIdB(const PfxBroadphasePair& p) { return pfxGetRigidBodyIdB(p); }
// The unique value of two bodies, the same in both orders.
inline PfxUInt32 pfxCalcUniqueKey(PfxUInt32 a, PfxUInt32 b) { return a < b ? b << 16 | a : a << 16 | b; }

// Grid coordinates of the bounds along axis 0, 1, 2.
inline PfxUInt32 pfxGetXYZMin(const PfxBroadphaseProxy& p, int axis);
inline PfxUInt32 pfxGetXYZMax(const PfxBroadphaseProxy& p, int axis);
inline PfxUInt32 pfxGetXMin(const PfxBroadphaseProxy& p) { return pfxGetXYZMin(p, 0); }
inline PfxUInt32 pfxGetYMin(const PfxBroadphaseProxy& p) { return pfxGetXYZMin(p, 1); }
inline PfxUInt32 pfxGetZMin(const PfxBroadphaseProxy& p) { return pfxGetXYZMin(p, 2); }
inline PfxUInt32 pfxGetXMax(const PfxBroadphaseProxy& p) { return pfxGetXYZMax(p, 0); }
inline PfxUInt32 pfxGetYMax(const PfxBroadphaseProxy& p) { return pfxGetXYZMax(p, 1); }
inline PfxUInt32 pfxGetZMax(const PfxBroadphaseProxy& p) { return pfxGetXYZMax(p, 2); }
inline PfxUInt16 pfxGetRigidBodyId(const PfxBroadphaseProxy& p) { return p.get16(8); }
inline PfxUInt16 pfxGetObjectId(const PfxBroadphaseProxy& p) { return p.get16(8); }
inline PfxUInt8 pfxGetMotionMask(const PfxBroadphaseProxy& p) { return p.get8(18); }
inline PfxUInt32 pfxGetSelf(const PfxBroadphaseProxy& p) { return p.get32(5); }
inline PfxUInt32 pfxGetTarget(const PfxBroadphaseProxy& p) { return p.get32(6); }

// Writes the proxy of one body for a sweep along `axis` (0, 1, 2: from the lower end; 3, 4, 5: X, Y, Z from the upper end).
// SCE_PFX_ERR_OUT_OF_WORLD when the bounds do not meet the world or are not finite; the proxy is written all the same.
// SCE_PFX_ERR_INVALID_VALUE for another axis or a world without extent.
PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& proxy, const PfxRigidState& state, const PfxCollidable& collidable,
                                  const PfxVector3& worldCenter, const PfxVector3& worldExtent, PfxUInt32 axis);

// The same for three or six axes at once.
PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& proxyX, PfxBroadphaseProxy& proxyY, PfxBroadphaseProxy& proxyZ,
                                  const PfxRigidState& state, const PfxCollidable& collidable,
                                  const PfxVector3& worldCenter, const PfxVector3& worldExtent);
PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& proxyX, PfxBroadphaseProxy& proxyY, PfxBroadphaseProxy& proxyZ,
                                  PfxBroadphaseProxy& proxyXb, PfxBroadphaseProxy& proxyYb, PfxBroadphaseProxy& proxyZb,
                                  const PfxRigidState& state, const PfxCollidable& collidable,
                                  const PfxVector3& worldCenter, const PfxVector3& worldExtent);

// Bodies, the arrays to write, and the world: centre and half extent, m.
struct PfxUpdateBroadphaseProxiesParam {
  // Scratch, aligned to 16 bytes, of pfxGetWorkBytesOfUpdateBroadphaseProxies() bytes; arrays of numRigidBodies; flags for what
  // is outside.
  void* workBuff = nullptr;
  PfxUInt32 workBytes = 0;
  SCE_PFX_NUM_RIGID_BODIES_;
  PfxRigidState* offsetRigidStates = nullptr;
  PfxCollidable* offsetCollidables = nullptr;
  PfxBroadphaseProxy* proxiesX = nullptr;  // arrays of numRigidBodies; those that are NULL are left out
  PfxBroadphaseProxy* proxiesY = nullptr;
  PfxBroadphaseProxy* proxiesZ = nullptr;
  PfxBroadphaseProxy* proxiesXb = nullptr;
  PfxBroadphaseProxy* proxiesYb = nullptr;
  PfxBroadphaseProxy* proxiesZb = nullptr;
  PfxVector3 worldCenter = PfxVector3(0.0f);
  PfxVector3 worldExtent = PfxVector3(500.0f);
  PfxUInt32 outOfWorldBehavior = 0;
};
// How many proxies there are.
struct PfxUpdateBroadphaseProxiesResult {
  // Bodies outside of the world.
  PfxInt32 numOutOfWorldProxies = 0;
  PfxInt32 numProxies = 0;  // in each array: all bodies, less those outside when they are removed
};
// Bytes of scratch for so many bodies, whatever the number of tasks.
PfxUInt32 pfxGetWorkBytesOfUpdateBroadphaseProxies(PfxUInt32 numRigidBodies, PfxUInt32 maxTasks = 1);
// Writes and sorts the arrays that are given.
PfxInt32 pfxUpdateBroadphaseProxies(PfxUpdateBroadphaseProxiesParam& param, PfxUpdateBroadphaseProxiesResult& result,
                                    PfxTaskManager* taskManager = nullptr);

// Sorted proxies, and the buffers for their pairs.
struct PfxFindPairsParam {
  // Buffers of the two sizes below, the proxies, and the axis (0, 1, 2) that they were sorted along.
  void* workBuff = nullptr;
  PfxUInt32 workBytes = 0;
  void* pairBuff = nullptr;  // aligned to 16 bytes
  PfxUInt32 pairBytes = 0;
  PfxBroadphaseProxy* proxies = nullptr;  // sorted along the axis
  PfxUInt32 numProxies = 0;
  PfxUInt32 maxPairs = 0;
  int axis = 0;
};
// The pairs that were found.
struct PfxFindPairsResult {
  // The list and its length.
  PfxBroadphasePair* pairs = nullptr;  // in the pair buffer, sorted by the unique value of their bodies
  PfxUInt32 numPairs = 0;
};
// Bytes of scratch and of the pair buffer for up to maxPairs pairs.
PfxUInt32 pfxGetWorkBytesOfFindPairs(PfxUInt32 maxPairs, PfxUInt32 maxTasks = 1);
PfxUInt32 pfxGetPairBytesOfFindPairs(PfxUInt32 maxPairs);
// All pairs whose bounds meet and that filters and motion types admit.
// SCE_PFX_ERR_OUT_OF_MAX_PAIRS: more than maxPairs; numPairs is 0 then, and a call with a larger buffer finds all.
PfxInt32 pfxFindPairs(PfxFindPairsParam& param, PfxFindPairsResult& result, PfxTaskManager* taskManager = nullptr);

// The sorted pairs of two steps, and the buffers for what changed.
struct PfxDecomposePairsParam {
  // Buffers of the two sizes below, and the pairs.
  void* workBuff = nullptr;
  PfxUInt32 workBytes = 0;
  void* pairBuff = nullptr;  // aligned to 16 bytes
  PfxUInt32 pairBytes = 0;
  PfxBroadphasePair* previousPairs = nullptr;  // sorted
  PfxUInt32 numPreviousPairs = 0;
  PfxBroadphasePair* currentPairs = nullptr;  // sorted
  PfxUInt32 numCurrentPairs = 0;
};
// Pairs of this step alone, of both, and of the step before alone.
struct PfxDecomposePairsResult {  // in the pair buffer
  // Each list is sorted and lies in the pair buffer.
  PfxBroadphasePair* outNewPairs = nullptr;
  PfxUInt32 numOutNewPairs = 0;
  PfxBroadphasePair* outKeepPairs = nullptr;  // with the contact ids of the previous pairs
  PfxUInt32 numOutKeepPairs = 0;
  PfxBroadphasePair* outRemovePairs = nullptr;
  PfxUInt32 numOutRemovePairs = 0;
};
// Bytes of scratch and of the pair buffer for lists of these lengths.
PfxUInt32 pfxGetWorkBytesOfDecomposePairs(PfxUInt32 numPreviousPairs, PfxUInt32 numCurrentPairs, PfxUInt32 maxTasks = 1);
PfxUInt32 pfxGetPairBytesOfDecomposePairs(PfxUInt32 numPreviousPairs, PfxUInt32 numCurrentPairs);
// SCE_PFX_ERR_INVALID_VALUE also for lists that are not sorted.
PfxInt32 pfxDecomposePairs(PfxDecomposePairsParam& param, PfxDecomposePairsResult& result,
                           PfxTaskManager* taskManager = nullptr);

// Six numbers of 21 bits in the first 16 bytes of a proxy: lower ends, then upper ends.
#define SCE_PFX_PROXY_GRID_MAX_ 0x1fffffu

inline PfxUInt32 pfxGetXYZMin(const PfxBroadphaseProxy& p, int axis) {
  const PfxUInt64 low = PfxUInt64(p.get32(1)) << 32 | p.get32(0);
  return static_cast<PfxUInt32>(low >> 21 * axis) & SCE_PFX_PROXY_GRID_MAX_;
}
inline PfxUInt32 pfxGetXYZMax(const PfxBroadphaseProxy& p, int axis) {
  const PfxUInt64 high = PfxUInt64(p.get32(3)) << 32 | p.get32(2);
  return static_cast<PfxUInt32>(high >> 21 * axis) & SCE_PFX_PROXY_GRID_MAX_;
}

}  // namespace PhysicsEffects
}  // namespace sce
