// Chapters 4 to 6: rays with the six proxy arrays, islands, sort.
#include <gtest/gtest.h>

#include <vector>

#include "compat/physics_effects.h"

using namespace sce::PhysicsEffects;

namespace {

PfxConstraintPair pairOf(PfxUInt16 a, PfxUInt16 b) {
  PfxConstraintPair pair = {};
  pfxSetRigidBodyIdA(pair, a), pfxSetRigidBodyIdB(pair, b);
  pfxSetMotionMaskA(pair, PfxRigidState().getMotionMask()), pfxSetMotionMaskB(pair, PfxRigidState().getMotionMask());
  pfxSetActive(pair, true);
  return pair;
}

TEST(CompatRay, EachFilteredRayHitsItsOwnPlateAndTheFifthNone) {
  PfxRigidState states[4];
  PfxCollidable collidables[4];
  for (PfxUInt16 i = 0; i < 4; ++i) {
    PfxShape shape;
    shape.setBox(PfxBox(5.0f, 0.25f, 5.0f));
    collidables[i].addShape(shape);
    ASSERT_EQ(collidables[i].finish(), SCE_PFX_OK);
    states[i].setPosition(PfxVector3(0, 2.0f + 2.0f * i, 0));
    states[i].setMotionType(kPfxMotionTypeFixed);
    states[i].setContactFilterSelf(1u << i);
    states[i].setRigidBodyId(i);
  }
  PfxBroadphaseProxy proxies[6][4], work[4];
  PfxUpdateBroadphaseProxiesParam update;
  update.workBuff = work, update.workBytes = sizeof work;
  update.numRigidBodies = 4;
  update.offsetRigidStates = states, update.offsetCollidables = collidables;
  update.proxiesX = proxies[0], update.proxiesY = proxies[1], update.proxiesZ = proxies[2];
  update.proxiesXb = proxies[3], update.proxiesYb = proxies[4], update.proxiesZb = proxies[5];
  PfxUpdateBroadphaseProxiesResult updated;
  ASSERT_EQ(pfxUpdateBroadphaseProxies(update, updated), SCE_PFX_OK);
  EXPECT_EQ(updated.numOutOfWorldProxies, 0);

  PfxRayCastParam param;
  param.offsetRigidStates = states, param.offsetCollidables = collidables;
  param.proxiesX = proxies[0], param.proxiesY = proxies[1], param.proxiesZ = proxies[2];
  param.proxiesXb = proxies[3], param.proxiesYb = proxies[4], param.proxiesZb = proxies[5];
  param.numProxies = 4;
  PfxRayInput rays[5];
  PfxRayOutput hits[5];
  for (int i = 0; i < 5; ++i) {
    rays[i].m_startPosition = PfxVector3(i - 2.0f, 10, 0);
    rays[i].m_direction = PfxVector3(0, -10, 2);
    rays[i].m_contactFilterTarget = 1u << i;
  }
  pfxCastRays(rays, hits, 5, param);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(hits[i].m_contactFlag) << i;
    EXPECT_EQ(hits[i].m_rigidBodyId, i);
    EXPECT_NEAR(hits[i].m_contactPoint[1], 2.25f + 2.0f * i, 1e-5f);
    EXPECT_NEAR(hits[i].m_contactNormal[1], 1.0f, 1e-6f);
  }
  EXPECT_FALSE(hits[4].m_contactFlag);
}

TEST(CompatIsland, PairsThatAreAppendedJoinIslands) {
  PfxConstraintPair pairs[] = {pairOf(0, 1), pairOf(3, 4)}, joint[] = {pairOf(1, 4)};
  std::vector<PfxSortData16> buffer(64);
  PfxGenerateIslandParam param;
  param.islandBuff = buffer.data(), param.islandBytes = pfxGetIslandBytesOfGenerateIsland(5);
  param.pairs = pairs, param.numPairs = 2, param.numObjects = 5;
  PfxGenerateIslandResult result;
  ASSERT_EQ(pfxGenerateIsland(param, result), SCE_PFX_OK);
  EXPECT_EQ(pfxGetNumIslands(result.island), 3u);
  ASSERT_EQ(pfxAppendPairs(result.island, joint, 1), SCE_PFX_OK);
  EXPECT_EQ(pfxGetNumIslands(result.island), 2u);
  std::vector<PfxUInt32> bodies;
  for (PfxIslandUnit* u = pfxGetFirstUnitInIsland(result.island, 0); u != nullptr; u = pfxGetNextUnitInIsland(u))
    bodies.push_back(pfxGetUnitId(u));
  EXPECT_EQ(bodies, (std::vector<PfxUInt32>{0, 1, 3, 4}));
  param.islandBytes = 64;
  EXPECT_EQ(pfxGenerateIsland(param, result), SCE_PFX_ERR_OUT_OF_BUFFER);
}

TEST(CompatSort, AnyLengthIsSortedWithAndWithoutTasks) {
  alignas(16) char pool[1024];
  PfxPsp2TaskManager tasks(2, 2, pool, sizeof pool);
  ASSERT_EQ(tasks.initialize(), SCE_PFX_OK);
  for (const PfxUInt32 n : {0u, 1u, 2u, 3u, 64u, 20011u}) {
    std::vector<PfxSortData32> data(n), work(n);
    for (PfxUInt32 i = 0; i < n; ++i) pfxSetKey(data[i], i * 2654435761u);
    std::vector<PfxSortData32> same = data;
    ASSERT_EQ(pfxParallelSort(data.data(), n, work.data(), n * 32), SCE_PFX_OK);
    ASSERT_EQ(pfxParallelSort(same.data(), n, work.data(), n * 32, &tasks), SCE_PFX_OK);
    for (PfxUInt32 i = 0; i < n; ++i) {
      ASSERT_LE(pfxGetKey(data[i == 0 ? 0 : i - 1]), pfxGetKey(data[i]));
      ASSERT_EQ(pfxGetKey(data[i]), pfxGetKey(same[i]));
    }
  }
  EXPECT_EQ(tasks.finalize(), SCE_PFX_OK);
}

}  // namespace
