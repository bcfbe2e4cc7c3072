// Chapters 2, 3 and 8: a convex mesh, a large mesh with each pair of flags, rays on it, and all that debug rendering draws.
#include <cmath>
#include <vector>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

static int points = 0, lines = 0, arcs = 0, aabbs = 0, boxes = 0;
static void drawPoint(const PfxVector3&, const PfxVector3&) { points++; }
static void drawLine(const PfxVector3&, const PfxVector3&, const PfxVector3&) { lines++; }
static void drawArc(const PfxVector3&, const PfxVector3&, const PfxVector3&, const PfxFloat, const PfxFloat, const PfxFloat, const PfxVector3&) { arcs++; }
static void drawAabb(const PfxVector3&, const PfxVector3&, const PfxVector3&) { aabbs++; }
static void drawBox(const PfxTransform3&, const PfxVector3&, const PfxVector3&) { boxes++; }
static int drawn(int& counter) {
  const int n = counter;
  counter = 0;
  return n;
}

#define GRID 9
static PfxFloat verts[GRID * GRID * 3];
static PfxUInt16 triangles[(GRID - 1) * (GRID - 1) * 6];
static PfxRigidState state;
static PfxCollidable collidable;

static void createGrid() {
  PfxUInt16* t = triangles;
  for (int z = 0; z < GRID; z++)
    for (int x = 0; x < GRID; x++) {
      PfxFloat* v = verts + 3 * (z * GRID + x);
      v[0] = 2.0f * x - 8.0f;
      v[1] = 0.1f * (x % 2);
      v[2] = 2.0f * z - 8.0f;
      if (x == GRID - 1 || z == GRID - 1) continue;
      const PfxUInt16 i = (PfxUInt16)(z * GRID + x);
      const PfxUInt16 quad[6] = {i, (PfxUInt16)(i + GRID), (PfxUInt16)(i + 1), (PfxUInt16)(i + 1), (PfxUInt16)(i + GRID), (PfxUInt16)(i + GRID + 1)};
      for (int k = 0; k < 6; k++) *t++ = quad[k];
    }
}

static void castDown(PfxFloat x, PfxFloat height) {
  static PfxBroadphaseProxy proxies[6];
  pfxUpdateBroadphaseProxy(proxies[0], proxies[1], proxies[2], proxies[3], proxies[4], proxies[5], state, collidable, PfxVector3(0.0f), PfxVector3(100.0f));
  PfxRayCastParam param;
  param.offsetRigidStates = &state;
  param.offsetCollidables = &collidable;
  param.proxiesX = &proxies[0];
  param.proxiesY = &proxies[1];
  param.proxiesZ = &proxies[2];
  param.proxiesXb = &proxies[3];
  param.proxiesYb = &proxies[4];
  param.proxiesZb = &proxies[5];
  param.numProxies = 1;
  param.rangeCenter = PfxVector3(0.0f);
  param.rangeExtent = PfxVector3(100.0f);
  PfxRayInput ray;
  ray.reset();
  ray.m_startPosition = PfxVector3(x, 5.0f, 0.5f);
  ray.m_direction = PfxVector3(0.0f, -10.0f, 0.0f);
  PfxRayOutput out;
  pfxCastSingleRay(ray, out, param);
  CHECK(out.m_contactFlag);
  CHECK(std::fabs(out.m_contactPoint[1] - height) < 1e-3f);
  CHECK(out.m_subData.m_type == PfxSubData::MESH_INFO);
  CHECK(out.m_subData.getUserData() >= 1000u);
  ray.m_startPosition = PfxVector3(x, -5.0f, 0.5f);
  ray.m_direction = PfxVector3(0.0f, 10.0f, 0.0f);
  pfxCastSingleRay(ray, out, param);
  CHECK(!out.m_contactFlag);  // only the front by default
  ray.m_facetMode = SCE_PFX_RAY_FACET_MODE_FRONT_AND_BACK;
  pfxCastSingleRay(ray, out, param);
  CHECK(out.m_contactFlag);
}

int main() {
  createGrid();
  PfxDebugRender* debugRender = new PfxDebugRender();
  debugRender->setDebugRenderPointFunc(drawPoint);
  debugRender->setDebugRenderLineFunc(drawLine);
  debugRender->setDebugRenderArcFunc(drawArc);
  debugRender->setDebugRenderAabbFunc(drawAabb);
  debugRender->setDebugRenderBoxFunc(drawBox);
  debugRender->resetVisible(1);

  const PfxUInt32 flags[4] = {0, SCE_PFX_MESH_FLAG_USE_QUANTIZED, SCE_PFX_MESH_FLAG_USE_BVH, SCE_PFX_MESH_FLAG_USE_BVH | SCE_PFX_MESH_FLAG_USE_QUANTIZED};
  const PfxUInt8 types[4] = {SCE_PFX_LARGE_MESH_TYPE_EXPANDED_ARRAY, SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_ARRAY, SCE_PFX_LARGE_MESH_TYPE_EXPANDED_BVH, SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_BVH};
  const PfxUInt32 numTriangles = (GRID - 1) * (GRID - 1) * 2;
  std::vector<PfxUInt32> userData;
  for (PfxUInt32 i = 0; i < numTriangles; i++) userData.push_back(1000 + i);
  for (int i = 0; i < 4; i++) {
    PfxLargeTriMesh mesh;
    PfxCreateLargeTriMeshParam param;
    param.flag = flags[i] | SCE_PFX_MESH_FLAG_16BIT_INDEX | SCE_PFX_MESH_FLAG_AUTO_ELIMINATION | SCE_PFX_MESH_FLAG_HIGH_QUALITY;
    param.verts = verts;
    param.numVerts = GRID * GRID;
    param.vertexStrideBytes = sizeof(PfxFloat) * 3;
    param.triangles = triangles;
    param.numTriangles = numTriangles;
    param.triangleStrideBytes = sizeof(PfxUInt16) * 3;
    param.userData = userData.data();
    param.userDataStrideBytes = sizeof(PfxUInt32);
    CHECK(pfxCreateLargeTriMesh(mesh, param) == SCE_PFX_OK);
    CHECK(mesh.m_type == types[i]);
    CHECK(mesh.m_numIslands >= 2 && mesh.m_numIslands <= 512);

    PfxShape shape;
    shape.reset();
    shape.setLargeTriMesh(&mesh);
    collidable.reset();
    collidable.addShape(shape);
    collidable.finish();
    state.reset();
    state.setMotionType(kPfxMotionTypeFixed);
    castDown(-3.0f, 0.05f);
    castDown(2.0f, 0.1f);

    const int islands = mesh.m_numIslands, n = (int)numTriangles;
    debugRender->renderLargeMesh(&state, &collidable, 1, SCE_PFX_DRENDER_MESH_FLG_ISLAND);
    CHECK(drawn(boxes) + drawn(aabbs) == islands);
    debugRender->renderLargeMesh(&state, &collidable, 1, SCE_PFX_DRENDER_MESH_FLG_EDGE);
    CHECK(drawn(lines) == 3 * n);
    debugRender->renderLargeMesh(&state, &collidable, 1, SCE_PFX_DRENDER_MESH_FLG_NORMAL);
    CHECK(drawn(lines) == n);
    debugRender->renderLargeMesh(&state, &collidable, 1, SCE_PFX_DRENDER_MESH_FLG_FACET_AABB);
    CHECK(drawn(boxes) + drawn(aabbs) == n);
    debugRender->renderLargeMesh(&state, &collidable, 1, SCE_PFX_DRENDER_MESH_FLG_EDGE | SCE_PFX_DRENDER_MESH_FLG_THICKNESS);
    CHECK(drawn(lines) == 9 * n);
    CHECK(debugRender->setLargeMeshFlag(0, 0, 1, SCE_PFX_DRENDER_MESH_FLG_EDGE) == SCE_PFX_OK);
    CHECK(debugRender->setLargeMeshFlag(0, 512, 0, SCE_PFX_DRENDER_MESH_FLG_EDGE) != SCE_PFX_OK);
    CHECK(debugRender->setLargeMeshFlag(0, 0, 64, SCE_PFX_DRENDER_MESH_FLG_EDGE) != SCE_PFX_OK);
    debugRender->renderLargeMeshByFlag(&state, &collidable, 1);
    CHECK(drawn(lines) == 3);
    debugRender->setLargeMeshFlag(0, 0, 1, 0);
    pfxReleaseLargeTriMesh(mesh);
  }

  const PfxFloat tetra[12] = {0, 1, 0, -1, -1, 1, 1, -1, 1, 0, -1, -1};
  const PfxUInt16 faces[12] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  PfxConvexMesh convex;
  PfxCreateConvexMeshParam cparam;
  cparam.verts = tetra;
  cparam.numVerts = 4;
  cparam.vertexStrideBytes = sizeof(PfxFloat) * 3;
  cparam.triangles = faces;
  cparam.numTriangles = 4;
  cparam.triangleStrideBytes = sizeof(PfxUInt16) * 3;
  CHECK(pfxCreateConvexMesh(convex, cparam) == SCE_PFX_OK);
  PfxShape shape;
  shape.reset();
  shape.setConvexMesh(&convex);
  collidable.reset();
  collidable.addShape(shape);
  collidable.finish();
  CHECK(std::fabs(collidable.getHalf()[1] - 1.0f) < 1e-5f);
  debugRender->renderWorld(PfxVector3(0.0f), PfxVector3(500.0f));
  debugRender->renderAabb(&state, &collidable, 1);
  CHECK(drawn(aabbs) == 2);
  debugRender->renderLocalAxis(&state, 1);
  CHECK(drawn(lines) == 3);
  debugRender->setVisible(0, false);
  debugRender->renderAabb(&state, &collidable, 1);
  CHECK(drawn(aabbs) == 0);

  PfxRigidState ends[2];
  ends[1].setRigidBodyId(1);
  PfxJoint joint;
  PfxHingeJointInitParam hinge;
  hinge.lowerAngle = -0.5f;
  hinge.upperAngle = 0.5f;
  CHECK(pfxInitializeHingeJoint(joint, ends[0], ends[1], hinge) == SCE_PFX_OK);
  debugRender->renderJoint(&joint, 1, ends);
  CHECK(drawn(points) == 2 && drawn(lines) == 6 && drawn(arcs) == 1);
  delete debugRender;
  pfxReleaseConvexMesh(convex);
  return failures == 0 ? 0 : 1;
}
