// Chapters 4 to 6: every stage that takes a task manager gives the same bits with any number of tasks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "tests/compat/scene.h"
#include "tests/compat/terrain.h"

using namespace compat_tests;

namespace {

// Managers of 1, 2, 3 and 8 tasks, and none.
class CompatParallel : public testing::Test {
 protected:
  CompatParallel() {
    for (const PfxUInt32 n : {1u, 2u, 3u, 8u}) {
      buffers_.push_back(std::make_unique<Buffer>(PfxTaskManager::getWorkBytes(n)));
      managers_.push_back(std::make_unique<PfxTaskManager>(n, n, buffers_.back()->data, buffers_.back()->bytes));
      EXPECT_EQ(managers_.back()->initialize(), SCE_PFX_OK);
    }
  }
  std::vector<PfxTaskManager*> all() {
    std::vector<PfxTaskManager*> list = {nullptr};
    for (const auto& m : managers_) list.push_back(m.get());
    return list;
  }

 private:
  std::vector<std::unique_ptr<Buffer>> buffers_;
  std::vector<std::unique_ptr<PfxTaskManager>> managers_;
};

// 3000 boxes in a cube, a tenth of them outside of the world.
struct Crowd {
  std::vector<PfxRigidState> states{3000};
  std::vector<PfxCollidable> collidables{3000};
  Crowd() {
    std::mt19937 random(1);
    PfxShape shape;
    shape.setBox(PfxBox(0.5f, 0.5f, 0.5f));
    for (PfxUInt16 i = 0; i < 3000; ++i) {
      PfxVector3 p;
      for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(random() % 20000) * 1e-3f - 10.0f;
      if (i % 10 == 3) p[1] += 100.0f;
      states[i].setPosition(p);
      states[i].setRigidBodyId(i);
      collidables[i].addShape(shape);
      collidables[i].finish();
    }
  }
};

template <class Record>
::testing::AssertionResult same(const std::vector<Record>& a, const std::vector<Record>& b) {
  if (a.size() != b.size()) return ::testing::AssertionFailure() << a.size() << " and " << b.size();
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(Record)) == 0 ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << "other bits";
}

struct Broadphase {
  std::vector<PfxBroadphaseProxy> arrays[6];
  PfxUpdateBroadphaseProxiesResult result;
  std::vector<PfxBroadphasePair> pairs;
};

Broadphase runBroadphase(Crowd crowd, PfxTaskManager* tasks, PfxUInt32 behavior) {
  Broadphase b;
  const PfxUInt32 n = static_cast<PfxUInt32>(crowd.states.size());
  for (auto& a : b.arrays) a.resize(n);
  Buffer work(pfxGetWorkBytesOfUpdateBroadphaseProxies(n, 8));
  PfxUpdateBroadphaseProxiesParam p;
  p.workBuff = work.data, p.workBytes = work.bytes, p.numRigidBodies = n;
  p.offsetRigidStates = crowd.states.data(), p.offsetCollidables = crowd.collidables.data();
  p.proxiesX = b.arrays[0].data(), p.proxiesY = b.arrays[1].data(), p.proxiesZ = b.arrays[2].data();
  p.proxiesXb = b.arrays[3].data(), p.proxiesYb = b.arrays[4].data(), p.proxiesZb = b.arrays[5].data();
  p.worldExtent = PfxVector3(20.0f);
  p.outOfWorldBehavior = behavior;
  EXPECT_EQ(pfxUpdateBroadphaseProxies(p, b.result, tasks), SCE_PFX_OK);
  for (auto& a : b.arrays) a.resize(static_cast<size_t>(b.result.numProxies));

  PfxFindPairsParam find;
  find.maxPairs = 100000;
  Buffer find_work(pfxGetWorkBytesOfFindPairs(find.maxPairs, 8)), pairs(pfxGetPairBytesOfFindPairs(find.maxPairs));
  find.workBuff = find_work.data, find.workBytes = find_work.bytes, find.pairBuff = pairs.data, find.pairBytes = pairs.bytes;
  find.proxies = b.arrays[1].data(), find.numProxies = static_cast<PfxUInt32>(b.result.numProxies), find.axis = 1;
  PfxFindPairsResult found;
  EXPECT_EQ(pfxFindPairs(find, found, tasks), SCE_PFX_OK);
  b.pairs.assign(found.pairs, found.pairs + found.numPairs);
  return b;
}

TEST_F(CompatParallel, ProxiesAndPairsAreTheSameForAnyNumberOfTasks) {
  const Crowd crowd;
  for (const PfxUInt32 behavior : {0u, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY, 3u}) {
    const Broadphase serial = runBroadphase(crowd, nullptr, behavior);
    EXPECT_EQ(serial.result.numOutOfWorldProxies, 300);
    EXPECT_EQ(serial.result.numProxies, behavior & SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY ? 2700 : 3000);
    EXPECT_GT(serial.pairs.size(), 1000u);
    for (PfxTaskManager* tasks : all()) {
      const Broadphase b = runBroadphase(crowd, tasks, behavior);
      EXPECT_EQ(b.result.numOutOfWorldProxies, 300);
      for (int k = 0; k < 6; ++k) EXPECT_TRUE(same(b.arrays[k], serial.arrays[k])) << k;
      EXPECT_TRUE(same(b.pairs, serial.pairs));
    }
  }
}

std::vector<PfxBroadphasePair> randomPairs(PfxUInt32 seed, size_t count) {
  std::mt19937 random(seed);
  std::vector<PfxUInt32> keys;
  for (size_t i = 0; i < count; ++i) keys.push_back(pfxCalcUniqueKey(random() % 300, 300 + random() % 300));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<PfxBroadphasePair> pairs(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    pairs[i] = PfxBroadphasePair();
    pfxSetRigidBodyIdA(pairs[i], static_cast<PfxUInt16>(keys[i])), pfxSetRigidBodyIdB(pairs[i], static_cast<PfxUInt16>(keys[i] >> 16));
    pfxSetKey(pairs[i], keys[i]);
    pfxSetContactId(pairs[i], static_cast<PfxUInt32>(seed * 100000 + i));
  }
  return pairs;
}

TEST_F(CompatParallel, DecompositionIsSetArithmeticForAnyNumberOfTasks) {
  for (const auto& [num_prev, num_cur] : {std::pair<size_t, size_t>{40000, 40000}, {40000, 500}, {500, 40000}, {0, 5000}, {5000, 0}, {0, 0}}) {
    std::vector<PfxBroadphasePair> prev = randomPairs(1, num_prev), cur = randomPairs(2, num_cur);
    const auto by_key = [](const PfxBroadphasePair& a, const PfxBroadphasePair& b) { return a.key() < b.key(); };
    std::vector<PfxBroadphasePair> fresh, kept, gone;
    std::set_difference(cur.begin(), cur.end(), prev.begin(), prev.end(), std::back_inserter(fresh), by_key);
    std::set_difference(prev.begin(), prev.end(), cur.begin(), cur.end(), std::back_inserter(gone), by_key);
    std::set_intersection(prev.begin(), prev.end(), cur.begin(), cur.end(), std::back_inserter(kept), by_key);
    for (PfxTaskManager* tasks : all()) {
      PfxDecomposePairsParam p;
      p.numPreviousPairs = static_cast<PfxUInt32>(prev.size()), p.numCurrentPairs = static_cast<PfxUInt32>(cur.size());
      Buffer work(pfxGetWorkBytesOfDecomposePairs(p.numPreviousPairs, p.numCurrentPairs, 8));
      Buffer out(pfxGetPairBytesOfDecomposePairs(p.numPreviousPairs, p.numCurrentPairs));
      p.workBuff = work.data, p.workBytes = work.bytes, p.pairBuff = out.data, p.pairBytes = out.bytes;
      p.previousPairs = prev.data(), p.currentPairs = cur.data();
      PfxDecomposePairsResult r;
      ASSERT_EQ(pfxDecomposePairs(p, r, tasks), SCE_PFX_OK);
      EXPECT_TRUE(same(std::vector<PfxBroadphasePair>(r.outNewPairs, r.outNewPairs + r.numOutNewPairs), fresh));
      EXPECT_TRUE(same(std::vector<PfxBroadphasePair>(r.outKeepPairs, r.outKeepPairs + r.numOutKeepPairs), kept));
      EXPECT_TRUE(same(std::vector<PfxBroadphasePair>(r.outRemovePairs, r.outRemovePairs + r.numOutRemovePairs), gone));
      if (cur.size() < 2000) continue;
      std::swap(cur[600], cur[1700]);
      EXPECT_EQ(pfxDecomposePairs(p, r, tasks), SCE_PFX_ERR_INVALID_VALUE);  // not sorted
      std::swap(cur[600], cur[1700]);
    }
  }
}

TEST_F(CompatParallel, SortsAreTheSameForAnyNumberOfTasks) {
  std::mt19937 random(9);
  std::vector<PfxSortData32> data(60000);
  for (PfxUInt32 i = 0; i < data.size(); ++i) data[i] = PfxSortData32(), data[i].set32(0, i), pfxSetKey(data[i], random() % 5000);
  std::vector<PfxSortData32> expected = data;
  std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.key() < b.key(); });
  for (PfxTaskManager* tasks : all()) {
    std::vector<PfxSortData32> sorted = data, work(data.size());
    ASSERT_EQ(pfxParallelSort(sorted.data(), 60000, work.data(), 60000 * sizeof(PfxSortData32), tasks), SCE_PFX_OK);
    EXPECT_TRUE(same(sorted, expected));
  }
}

// A pile on a mesh floor in two bodies, some of it on joints: detection, refresh, set-up, solving and integration.
TEST_F(CompatParallel, APileOnMeshesAndJointsIsTheSameForAnyNumberOfTasks) {
  PfxLargeTriMesh mesh;
  ASSERT_EQ(createRectangle(mesh, 20.0f, 20.0f), SCE_PFX_OK);
  std::vector<PfxVector3> expected;
  for (PfxTaskManager* tasks : all()) {
    Scene scene;
    scene.tasks = tasks;
    PfxShape ground;
    ground.setLargeTriMesh(&mesh);
    scene.add(ground, PfxVector3(-20, 0, 0), kPfxMotionTypeFixed);
    scene.add(ground, PfxVector3(0, 0, 0), kPfxMotionTypeFixed);
    for (int i = 0; i < 150; ++i)
      scene.addBox(PfxVector3(0.4f), PfxVector3(1.0f * (i % 10) - 5.0f + 0.01f * i, 0.5f + 0.85f * (i / 50), 1.1f * (i / 10 % 5)), kPfxMotionTypeActive);
    for (PfxUInt16 i = 10; i < 140; i = static_cast<PfxUInt16>(i + 10)) {
      scene.joints.emplace_back();
      PfxBallJointInitParam ball;
      ball.anchorPoint = scene.states[i].getPosition();
      ASSERT_EQ(pfxInitializeBallJoint(scene.joints.back(), scene.states[i], scene.states[i + 1u], ball), SCE_PFX_OK);
    }
    for (int i = 0; i < 30; ++i) scene.step();
    std::vector<PfxVector3> positions;
    for (const PfxRigidState& s : scene.states) positions.push_back(s.getPosition());
    if (expected.empty()) expected = positions;
    for (size_t i = 0; i < positions.size(); ++i)
      for (int k = 0; k < 3; ++k) ASSERT_EQ(positions[i][k], expected[i][k]) << i;
  }
  pfxReleaseLargeTriMesh(mesh);
}

TEST_F(CompatParallel, ABatchOfRaysIsWhatSingleRaysAre) {
  Crowd crowd;
  const Broadphase b = runBroadphase(crowd, nullptr, 0);
  Broadphase proxies = b;
  PfxRayCastParam p;
  p.offsetRigidStates = crowd.states.data(), p.offsetCollidables = crowd.collidables.data();
  p.proxiesX = proxies.arrays[0].data(), p.proxiesY = proxies.arrays[1].data(), p.proxiesZ = proxies.arrays[2].data();
  p.proxiesXb = proxies.arrays[3].data(), p.proxiesYb = proxies.arrays[4].data(), p.proxiesZb = proxies.arrays[5].data();
  p.numProxies = 3000, p.rangeExtent = PfxVector3(20.0f);
  std::mt19937 random(4);
  std::vector<PfxRayInput> in(500);
  for (PfxRayInput& ray : in)
    for (int k = 0; k < 3; ++k) {
      ray.m_startPosition[k] = static_cast<float>(random() % 20000) * 1e-3f - 10.0f;
      ray.m_direction[k] = static_cast<float>(random() % 20000) * 1e-3f - 10.0f;
    }
  int hits = 0;
  std::vector<PfxRayOutput> single(in.size());
  for (size_t i = 0; i < in.size(); ++i) pfxCastSingleRay(in[i], single[i], p), hits += single[i].m_contactFlag;
  EXPECT_GT(hits, 100);
  for (PfxTaskManager* tasks : all()) {
    std::vector<PfxRayOutput> out(in.size());
    pfxCastRays(in.data(), out.data(), static_cast<int>(in.size()), p, tasks);
    for (size_t i = 0; i < in.size(); ++i) {
      ASSERT_EQ(out[i].m_contactFlag, single[i].m_contactFlag) << i;
      ASSERT_EQ(out[i].m_variable, single[i].m_variable) << i;
      ASSERT_EQ(out[i].m_rigidBodyId, single[i].m_rigidBodyId) << i;
    }
  }
}

}  // namespace
