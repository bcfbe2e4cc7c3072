// Chapters 4 to 6: rays with the six proxy arrays, islands, sort.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/compat/terrain.h"

using namespace compat_tests;

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

// 200 bodies of every kind and 10000 rays. What a ray hits among all of them is the nearest of what it hits on each alone;
// spheres are held against the closed form too.
class CompatRayCloud : public testing::Test {
 protected:
  static constexpr PfxUInt16 kBodies = 200;
  struct Alone {
    PfxBroadphaseProxy proxies[6];
  };

  CompatRayCloud() : states_(kBodies), collidables_(kBodies), alone_(kBodies) {
    EXPECT_EQ(createRectangle(mesh_, 2.0f, 1.0f), SCE_PFX_OK);
    for (PfxUInt16 i = 0; i < kBodies; ++i) {
      EXPECT_EQ(collidables_[i].addShape(shapeOf(i)), SCE_PFX_OK);
      EXPECT_EQ(collidables_[i].finish(), SCE_PFX_OK);
      states_[i].setPosition(PfxVector3(at(), at(), at()));
      states_[i].setOrientation(normalize(PfxQuat(at(), at(), at(), at())));
      states_[i].setRigidBodyId(i);
      PfxBroadphaseProxy* p = alone_[i].proxies;
      pfxUpdateBroadphaseProxy(p[0], p[1], p[2], p[3], p[4], p[5], states_[i], collidables_[i], PfxVector3(0.0f), PfxVector3(50.0f));
      for (int k = 0; k < 6; ++k) all_[k].push_back(p[k]);
    }
    std::vector<PfxBroadphaseProxy> work(kBodies);
    for (auto& proxies : all_) EXPECT_EQ(pfxParallelSort(proxies.data(), kBodies, work.data(), kBodies * 32), SCE_PFX_OK);
  }
  ~CompatRayCloud() override { pfxReleaseLargeTriMesh(mesh_); }

  PfxFloat at() { return static_cast<PfxFloat>(random_() % 20001) * 1e-3f - 10.0f; }
  PfxShape shapeOf(PfxUInt16 i) {
    PfxShape shape;
    switch (i % 5) {
      case 0: shape.setSphere(PfxSphere(0.8f)); break;
      case 1: shape.setBox(PfxBox(0.5f, 0.7f, 0.9f)); break;
      case 2: shape.setCapsule(PfxCapsule(0.8f, 0.4f)); break;
      case 3: shape.setCylinder(PfxCylinder(0.8f, 0.5f)); break;
      default: shape.setLargeTriMesh(&mesh_);
    }
    return shape;
  }
  PfxRayCastParam paramOf(PfxBroadphaseProxy* const* proxies, PfxUInt32 count) {
    PfxRayCastParam p;
    p.offsetRigidStates = states_.data(), p.offsetCollidables = collidables_.data();
    p.proxiesX = proxies[0], p.proxiesY = proxies[1], p.proxiesZ = proxies[2];
    p.proxiesXb = proxies[3], p.proxiesYb = proxies[4], p.proxiesZb = proxies[5];
    p.numProxies = count, p.rangeExtent = PfxVector3(50.0f);
    return p;
  }
  PfxRayOutput bruteForce(const PfxRayInput& ray) {
    PfxRayOutput nearest;
    for (Alone& alone : alone_) {
      PfxBroadphaseProxy* p = alone.proxies;
      PfxBroadphaseProxy* const arrays[6] = {p, p + 1, p + 2, p + 3, p + 4, p + 5};
      PfxRayOutput out;
      pfxCastSingleRay(ray, out, paramOf(arrays, 1));
      if (out.m_contactFlag && (!nearest.m_contactFlag || out.m_variable < nearest.m_variable)) nearest = out;
    }
    return nearest;
  }
  // Where along the ray, 0 .. 1, the sphere begins; above 1: it is missed.
  double sphereHit(const PfxRayInput& ray, PfxUInt16 id) const {
    double dd = 0.0, dm = 0.0, mm = -0.8 * 0.8;
    for (int k = 0; k < 3; ++k) {
      const double d = ray.m_direction[k], m = double(ray.m_startPosition[k]) - states_[id].getPosition()[k];
      dd += d * d, dm += d * m, mm += m * m;
    }
    const double root = dm * dm - dd * mm;
    return root < 0.0 || mm < 0.0 || dm > 0.0 ? 2.0 : (-dm - std::sqrt(root)) / dd;
  }

  std::mt19937 random_{12};
  PfxLargeTriMesh mesh_;
  std::vector<PfxRigidState> states_;
  std::vector<PfxCollidable> collidables_;
  std::vector<Alone> alone_;
  std::vector<PfxBroadphaseProxy> all_[6];
};

TEST_F(CompatRayCloud, C5_14TenThousandRaysHitWhatBruteForceFinds) {
  PfxBroadphaseProxy* const arrays[6] = {all_[0].data(), all_[1].data(), all_[2].data(), all_[3].data(), all_[4].data(), all_[5].data()};
  const PfxRayCastParam param = paramOf(arrays, kBodies);
  int hits = 0, kinds[5] = {};
  double worst = 0.0;
  for (int i = 0; i < 10000; ++i) {
    PfxRayInput ray;
    ray.m_startPosition = PfxVector3(at(), at(), at());
    ray.m_direction = PfxVector3(at(), at(), at());
    PfxRayOutput out;
    pfxCastSingleRay(ray, out, param);
    const PfxRayOutput expected = bruteForce(ray);
    ASSERT_EQ(out.m_contactFlag, expected.m_contactFlag) << i;
    for (PfxUInt16 id = 0; id < kBodies; id = static_cast<PfxUInt16>(id + 5))  // nothing is in front of the hit
      ASSERT_GE(sphereHit(ray, id), out.m_contactFlag ? out.m_variable - 1e-5 : 1.0 - 1e-5) << i;
    if (!out.m_contactFlag) continue;
    ++hits, ++kinds[out.m_rigidBodyId % 5];
    ASSERT_EQ(out.m_rigidBodyId, expected.m_rigidBodyId) << i;
    ASSERT_EQ(out.m_variable, expected.m_variable) << i;
    EXPECT_NEAR(length(out.m_contactNormal), 1.0f, 1e-5f);
    EXPECT_LT(length(out.m_contactPoint - ray.m_startPosition - out.m_variable * ray.m_direction), 1e-4f);
    if (out.m_rigidBodyId % 5 == 0 && out.m_variable > 0.0f)
      worst = std::max(worst, std::abs(sphereHit(ray, out.m_rigidBodyId) - out.m_variable) * double(length(ray.m_direction)));
  }
  std::printf("%d of 10000 rays hit: %d spheres, %d boxes, %d capsules, %d cylinders, %d meshes; spheres off by %.1e m\n", hits,
              kinds[0], kinds[1], kinds[2], kinds[3], kinds[4], worst);
  for (const int n : kinds) EXPECT_GT(n, 100);
  EXPECT_LT(worst, 1e-5);
}

// In turn with std::sort, the best of ten.
TEST(CompatSort, C6_08AHundredThousandRecordsAreSortedFasterThanByTheStandardLibrary) {
  const PfxUInt32 n = 100000;
  std::mt19937 random(2);
  std::vector<PfxSortData32> data(n), work(n), sorted, other;
  for (PfxSortData32& d : data) pfxSetKey(d, static_cast<PfxUInt32>(random()));
  const auto ms = [](auto&& fn) {
    const auto start = std::chrono::steady_clock::now();
    fn();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  };
  const auto by_key = [](const PfxSortData32& a, const PfxSortData32& b) { return a.key() < b.key(); };
  double ours = 1e9, theirs = 1e9;
  for (int i = 0; i < 10; ++i) {
    sorted = other = data;
    ours = std::min(ours, ms([&] { ASSERT_EQ(pfxParallelSort(sorted.data(), n, work.data(), n * 32), SCE_PFX_OK); }));
    theirs = std::min(theirs, ms([&] { std::sort(other.begin(), other.end(), by_key); }));
  }
  for (PfxUInt32 i = 0; i < n; ++i) ASSERT_EQ(sorted[i].key(), other[i].key());
  std::printf("100000 records: %.2f ms, std::sort %.2f ms\n", ours, theirs);
  EXPECT_LT(ours, theirs);
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
