#include "compat/physics_effects/island.h"

#include <algorithm>

#include "compat/physics_effects/native.h"

namespace sce::PhysicsEffects {

struct PfxIslandUnit {
  PfxUInt32 id;
  PfxUInt32 parent;     // a body of the same island that is not higher; itself: the lowest
  PfxUInt32 island;     // number
  PfxUInt32 first;      // by island: its lowest body
  PfxIslandUnit* next;  // in the island
};

struct alignas(16) PfxIsland {
  PfxUInt32 num_objects;
  PfxUInt32 num_islands;
  PfxIslandUnit* units;
};

namespace {

PfxUInt32 root(PfxIslandUnit* units, PfxUInt32 i) {
  while (units[i].parent != i) i = units[i].parent = units[units[i].parent].parent;
  return i;
}

bool connects(const PfxConstraintPair& pair) {
  return pfxGetActive(pair) && (pfxGetMotionMaskA(pair) & SCE_PFX_MOTION_MASK_DYNAMIC) != 0 &&
         (pfxGetMotionMaskB(pair) & SCE_PFX_MOTION_MASK_DYNAMIC) != 0;
}

// Numbers the islands and chains their bodies, from the highest body down so that chains ascend.
void number(PfxIsland& island) {
  PfxIslandUnit* units = island.units;
  island.num_islands = 0;
  for (PfxUInt32 i = 0; i < island.num_objects; ++i) {
    const PfxUInt32 r = root(units, i);
    if (r == i) units[island.num_islands].first = i, units[i].island = island.num_islands++;
    units[i].island = units[r].island;
    units[i].next = nullptr;
  }
  for (PfxUInt32 i = island.num_objects; i-- > 0;) {
    const PfxUInt32 r = units[i].parent == i ? i : root(units, i);
    if (r == i) continue;
    units[i].next = units[r].next;
    units[r].next = &units[i];
  }
}

}  // namespace

PfxUInt32 pfxGetIslandBytesOfGenerateIsland(PfxUInt32 numObjects) {
  return SCE_PFX_BYTES_ALIGN16(static_cast<PfxUInt32>(sizeof(PfxIsland) + sizeof(PfxIslandUnit) * numObjects));
}
PfxUInt32 pfxGetWorkBytesOfGenerateIsland(PfxUInt32) { return 16; }

PfxInt32 pfxGenerateIsland(PfxGenerateIslandParam& param, PfxGenerateIslandResult& result) {
  result = {};
  if (param.islandBuff == nullptr || (param.numPairs > 0 && param.pairs == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(param.islandBuff)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (param.islandBytes < sizeof(PfxIsland) + sizeof(PfxIslandUnit) * param.numObjects) return SCE_PFX_ERR_OUT_OF_BUFFER;
  auto* island = static_cast<PfxIsland*>(param.islandBuff);
  *island = {param.numObjects, 0, reinterpret_cast<PfxIslandUnit*>(island + 1)};
  for (PfxUInt32 i = 0; i < param.numObjects; ++i) island->units[i] = {i, i, i, 0, nullptr};
  const PfxInt32 error = pfxAppendPairs(island, param.pairs, param.numPairs);
  if (error == SCE_PFX_OK) result.island = island;
  return error;
}

PfxInt32 pfxAppendPairs(PfxIsland* island, PfxConstraintPair* pairs, PfxUInt32 numPairs) {
  if (island == nullptr || (numPairs > 0 && pairs == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  for (PfxUInt32 i = 0; i < numPairs; ++i)
    if (pfxGetRigidBodyIdA(pairs[i]) >= island->num_objects || pfxGetRigidBodyIdB(pairs[i]) >= island->num_objects)
      return SCE_PFX_ERR_OUT_OF_RANGE;
  for (PfxUInt32 i = 0; i < numPairs; ++i) {
    if (!connects(pairs[i])) continue;
    const PfxUInt32 a = root(island->units, pfxGetRigidBodyIdA(pairs[i])), b = root(island->units, pfxGetRigidBodyIdB(pairs[i]));
    island->units[std::max(a, b)].parent = std::min(a, b);
  }
  number(*island);
  return SCE_PFX_OK;
}

PfxUInt32 pfxGetNumIslands(const PfxIsland* island) { return island == nullptr ? 0 : island->num_islands; }
PfxUInt32 pfxGetIslandId(const PfxIsland* island, PfxUInt32 objectId) {
  return island == nullptr || objectId >= island->num_objects ? 0xffffffffu : island->units[objectId].island;
}
PfxIslandUnit* pfxGetFirstUnitInIsland(const PfxIsland* island, PfxUInt32 islandId) {
  if (island == nullptr || islandId >= island->num_islands) return nullptr;
  return &island->units[island->units[islandId].first];
}
PfxIslandUnit* pfxGetNextUnitInIsland(const PfxIslandUnit* unit) { return unit == nullptr ? nullptr : unit->next; }
PfxUInt32 pfxGetUnitId(const PfxIslandUnit* unit) { return unit == nullptr ? 0xffffffffu : unit->id; }

}  // namespace sce::PhysicsEffects
