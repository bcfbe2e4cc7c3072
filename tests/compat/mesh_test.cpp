// Chapter 2: convex and large meshes: creation, limits, the four kinds of storage, memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include "tests/compat/scene.h"
#include "tests/compat/terrain.h"

using namespace compat_tests;

namespace {

std::map<void*, size_t> blocks;
void* countedAlloc(size_t align, size_t size) {
  void* p = std::aligned_alloc(align, (size + align - 1) / align * align);
  blocks[p] = size;
  return p;
}
void* countedRealloc(void*, size_t, size_t) { return nullptr; }
void countedFree(void* p) { blocks.erase(p), std::free(p); }
size_t bytes() {
  size_t sum = 0;
  for (const auto& block : blocks) sum += block.second;
  return sum;
}

class CompatMesh : public testing::Test {
 protected:
  void SetUp() override { pfxSetUtilityAllocator(countedAlloc, countedRealloc, countedFree); }
  void TearDown() override {
    EXPECT_TRUE(blocks.empty()) << bytes() << " bytes not released";
    pfxSetUtilityAllocator(nullptr, nullptr, nullptr);
    blocks.clear();
  }
};

// A ray straight down on a body of one mesh.
PfxRayOutput castDown(const PfxLargeTriMesh& mesh, PfxFloat x, PfxFloat z) {
  Scene scene;
  PfxShape shape;
  shape.setLargeTriMesh(&mesh);
  scene.add(shape, PfxVector3(0.0f), kPfxMotionTypeFixed);
  PfxBroadphaseProxy proxies[6][1];
  pfxUpdateBroadphaseProxy(proxies[0][0], proxies[1][0], proxies[2][0], proxies[3][0], proxies[4][0], proxies[5][0],
                           scene.states[0], scene.collidables[0], PfxVector3(0.0f), PfxVector3(500.0f));
  PfxRayCastParam param;
  param.offsetRigidStates = scene.states.data(), param.offsetCollidables = scene.collidables.data();
  param.proxiesX = proxies[0], param.proxiesY = proxies[1], param.proxiesZ = proxies[2];
  param.proxiesXb = proxies[3], param.proxiesYb = proxies[4], param.proxiesZb = proxies[5];
  param.numProxies = 1;
  PfxRayInput ray;
  ray.m_startPosition = PfxVector3(x, 10, z), ray.m_direction = PfxVector3(0, -20, 0);
  PfxRayOutput out;
  pfxCastSingleRay(ray, out, param);
  return out;
}

TEST_F(CompatMesh, FourKindsOfStorageHoldTheSameSurface) {
  const Terrain terrain(30);
  const PfxUInt32 flags[] = {0, SCE_PFX_MESH_FLAG_USE_QUANTIZED, SCE_PFX_MESH_FLAG_USE_BVH,
                             SCE_PFX_MESH_FLAG_USE_BVH | SCE_PFX_MESH_FLAG_USE_QUANTIZED};
  const int types[] = {SCE_PFX_LARGE_MESH_TYPE_EXPANDED_ARRAY, SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_ARRAY,
                       SCE_PFX_LARGE_MESH_TYPE_EXPANDED_BVH, SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_BVH};
  size_t size[4];
  for (int i = 0; i < 4; ++i) {
    for (const PfxUInt32 quality : {0u, SCE_PFX_MESH_FLAG_HIGH_QUALITY}) {
      PfxLargeTriMesh mesh;
      ASSERT_EQ(pfxCreateLargeTriMesh(mesh, terrain.param(flags[i] | quality)), SCE_PFX_OK);
      EXPECT_EQ(mesh.m_type, types[i]);
      size[i] = bytes();
      PfxUInt32 facets = 0;
      for (PfxUInt32 k = 0; k < mesh.m_numIslands; ++k) {
        EXPECT_LE(mesh.m_islands[k].m_numFacets, 64);
        facets += mesh.m_islands[k].m_numFacets;
      }
      EXPECT_EQ(facets, 1800u);
      for (int k = 0; k < 20; ++k) {
        const PfxFloat x = 0.3f + 1.4f * k, z = 29.25f - 1.33f * k;
        const PfxRayOutput hit = castDown(mesh, x, z);
        ASSERT_TRUE(hit.m_contactFlag);
        // In a cell whose corners have been written down, the facet that was hit is one of its two.
        EXPECT_EQ(hit.m_subData.getUserData() / 2, PfxUInt32(z) * 30 + PfxUInt32(x));
        EXPECT_NEAR(hit.m_contactPoint[1], 0.05f, 0.05f + 30.0f / 65535.0f);
        EXPECT_LT(hit.m_subData.getIslandId(), mesh.m_numIslands);
        EXPECT_LE(hit.m_subData.getFacetLocalS() + hit.m_subData.getFacetLocalT(), 1.0f + 1e-4f);
      }
      pfxReleaseLargeTriMesh(mesh);
      EXPECT_TRUE(blocks.empty());
    }
  }
  EXPECT_LT(size[1], 0.75 * size[0]);  // quantized: about half
  EXPECT_LT(size[3], 0.75 * size[2]);
  EXPECT_GT(size[2], size[0]);  // a hierarchy takes memory of its own
}

TEST_F(CompatMesh, TheLimitOfALargeMeshIs512IslandsOf64Triangles) {
  const Terrain most(128), more(139);  // 32768 and 38642 triangles
  for (const PfxUInt32 flag : {0u, SCE_PFX_MESH_FLAG_HIGH_QUALITY, SCE_PFX_MESH_FLAG_USE_BVH | SCE_PFX_MESH_FLAG_USE_QUANTIZED}) {
    PfxLargeTriMesh mesh;
    ASSERT_EQ(pfxCreateLargeTriMesh(mesh, most.param(flag)), SCE_PFX_OK) << flag;
    EXPECT_LE(mesh.m_numIslands, 512);
    pfxReleaseLargeTriMesh(mesh);
    EXPECT_EQ(pfxCreateLargeTriMesh(mesh, more.param(flag)), SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS);
    EXPECT_EQ(mesh.m_numFacets, 0u);
  }
}

TEST_F(CompatMesh, WrongInputIsAnErrorAndTakesNoMemory) {
  const Terrain terrain(2);
  PfxLargeTriMesh mesh;
  PfxCreateLargeTriMeshParam param = terrain.param(0);
  param.verts = nullptr;
  EXPECT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_ERR_INVALID_VALUE);
  param = terrain.param(0), param.numVerts = 3;
  EXPECT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_ERR_INVALID_VALUE);
  param = terrain.param(0), param.triangleStrideBytes = 4;
  EXPECT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_ERR_INVALID_VALUE);
  param = terrain.param(0), param.numFacetsLimit = 65;
  EXPECT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_ERR_OUT_OF_RANGE);
  pfxReleaseLargeTriMesh(mesh);  // nothing there
}

// A prism over a regular polygon of n corners: 4 n - 4 triangles.
PfxInt32 createPrism(PfxConvexMesh& mesh, PfxUInt16 n, PfxFloat dent = 0.0f) {
  std::vector<PfxFloat> verts;
  for (const PfxFloat y : {-1.0f, 1.0f})
    for (PfxUInt16 i = 0; i < n; ++i) {
      const PfxVector3 v = rotate(PfxQuat::rotationY(-2.0f * SCE_PFX_PI * i / n), PfxVector3(i == 0 ? 1.0f - dent : 1.0f, y, 0));
      for (int k = 0; k < 3; ++k) verts.push_back(v[k]);
    }
  std::vector<PfxUInt16> t;
  const auto add = [&t](int a, int b, int c) { for (const int i : {a, b, c}) t.push_back(static_cast<PfxUInt16>(i)); };
  for (int i = 1; i + 1 < n; ++i) add(0, i, i + 1), add(n, n + i + 1, n + i);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    add(i, n + i, j), add(j, n + i, n + j);
  }
  PfxCreateConvexMeshParam param;
  param.verts = verts.data(), param.numVerts = 2u * n;
  param.triangles = t.data(), param.numTriangles = static_cast<PfxUInt32>(t.size() / 3);
  return pfxCreateConvexMesh(mesh, param);
}

TEST_F(CompatMesh, AConvexMeshHasAtMost64Triangles) {
  PfxConvexMesh mesh;
  ASSERT_EQ(createPrism(mesh, 17), SCE_PFX_OK);  // 64
  EXPECT_EQ(mesh.m_numVerts, 34);
  EXPECT_EQ(mesh.m_numIndices, 192);
  EXPECT_NEAR(mesh.m_half[1], 1.0f, 1e-6f);
  EXPECT_FALSE(blocks.empty());
  pfxReleaseConvexMesh(mesh);
  EXPECT_EQ(createPrism(mesh, 18), SCE_PFX_ERR_OUT_OF_RANGE_TRIANGLES);
  EXPECT_NE(createPrism(mesh, 8, 0.9f), SCE_PFX_OK);  // concave
  EXPECT_EQ(mesh.m_native, nullptr);
}

TEST_F(CompatMesh, ABallRollsOverTheSeamOfTwoMeshes) {
  PfxLargeTriMesh mesh;
  ASSERT_EQ(createRectangle(mesh, 10.0f, 5.0f), SCE_PFX_OK);
  Scene scene;
  PfxShape ground, ball;
  ground.setLargeTriMesh(&mesh);
  scene.add(ground, PfxVector3(-10, 0, 0), kPfxMotionTypeFixed);
  scene.add(ground, PfxVector3(0, 0, 0), kPfxMotionTypeFixed);
  ball.setSphere(PfxSphere(0.5f));
  const PfxUInt16 id = scene.add(ball, PfxVector3(-2, 0.5f, 0), kPfxMotionTypeActive);
  scene.bodies[id].setInertia(pfxCalcInertiaSphere(0.5f, 1.0f));
  scene.states[id].setLinearVelocity(PfxVector3(4, 0, 0));
  scene.states[id].setAngularVelocity(PfxVector3(0, 0, -8));
  PfxFloat lowest = 1.0f, highest = 0.0f;
  for (int i = 0; i < 120; ++i) {
    scene.step();
    lowest = std::min(lowest, scene.states[id].getPosition()[1]);
    highest = std::max(highest, scene.states[id].getPosition()[1]);
  }
  std::printf("from %.3f mm to %.3f mm over the ground\n", 1e3 * double(lowest - 0.5f), 1e3 * double(highest - 0.5f));
  EXPECT_GT(lowest, 0.5f - 0.0012f);   // the slop of the solver
  EXPECT_LT(highest, 0.5f + 0.0005f);
  EXPECT_GT(scene.states[id].getPosition()[0], 3.0f);
  EXPECT_NEAR(scene.states[id].getPosition()[1], 0.5f, 0.005f);
  pfxReleaseLargeTriMesh(mesh);
}

}  // namespace
