// Islands: bodies that contacts and joints connect.
#pragma once

#include "broadphase.h"

namespace sce {
namespace PhysicsEffects {

// Lies in the island buffer, which it fills together with its units.
struct PfxIsland;
struct PfxIslandUnit;

// Pairs of this step, and the buffer that the islands fill.
struct PfxGenerateIslandParam {
  // Buffers, and the pairs that connect; ids in them are below numObjects.
  void* islandBuff = nullptr;  // aligned to 16 bytes
  PfxUInt32 islandBytes = 0;
  void* workBuff = nullptr;  // not needed
  PfxUInt32 workBytes = 0;
  PfxConstraintPair* pairs = nullptr;
  PfxUInt32 numPairs = 0;
  PfxUInt32 numObjects = 0;  // bodies
};
// The islands that were made.
struct PfxGenerateIslandResult {
  // At the start of the island buffer.
  PfxIsland* island = nullptr;
};
// Bytes of the buffers for so many bodies.
PfxUInt32 pfxGetIslandBytesOfGenerateIsland(PfxUInt32 numObjects);
PfxUInt32 pfxGetWorkBytesOfGenerateIsland(PfxUInt32 numObjects);
// Every body that is not connected by an active pair of two moving bodies is an island of its own; Fixed, Keyframe and
// Trigger bodies connect nothing. Islands are numbered by their lowest body.
PfxInt32 pfxGenerateIsland(PfxGenerateIslandParam& param, PfxGenerateIslandResult& result);
// Connects further pairs, such as those of the joints.
PfxInt32 pfxAppendPairs(PfxIsland* island, PfxConstraintPair* pairs, PfxUInt32 numPairs);

// Number of islands, and the island of a body.
PfxUInt32 pfxGetNumIslands(const PfxIsland* island);
PfxUInt32 pfxGetIslandId(const PfxIsland* island, PfxUInt32 objectId);
// The bodies of an island, ascending; NULL at the end.
PfxIslandUnit* pfxGetFirstUnitInIsland(const PfxIsland* island, PfxUInt32 islandId);
PfxIslandUnit* pfxGetNextUnitInIsland(const PfxIslandUnit* islandUnit);
PfxUInt32 pfxGetUnitId(const PfxIslandUnit* islandUnit);

}  // namespace PhysicsEffects
}  // namespace sce
