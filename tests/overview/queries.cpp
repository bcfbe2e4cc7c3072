// Chapters 3, 5 and 6: the task manager of the console, six arrays of proxies, rays one by one and in a batch, the sort.
#include <cmath>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

#define NUM_RIGIDBODIES 5

static PfxRigidState states[NUM_RIGIDBODIES];
static PfxRigidBody bodies[NUM_RIGIDBODIES];
static PfxCollidable collidables[NUM_RIGIDBODIES];
static PfxBroadphaseProxy proxies[6][NUM_RIGIDBODIES];

static void* allocate(PfxUInt32 bytes) { return SCE_PFX_UTIL_ALLOC(16, bytes); }

static void createShape(PfxUInt16 id, const PfxShape& shape, const PfxVector3& position) {
  collidables[id].reset();
  collidables[id].addShape(shape);
  collidables[id].finish();
  bodies[id].reset();
  states[id].reset();
  states[id].setPosition(position);
  states[id].setMotionType(kPfxMotionTypeActive);
  states[id].setRigidBodyId(id);
}

static PfxInt32 updateProxies(PfxUpdateBroadphaseProxiesResult& result, PfxUInt32 behavior, PfxTaskManager* taskManager) {
  PfxUpdateBroadphaseProxiesParam param;
  param.workBytes = pfxGetWorkBytesOfUpdateBroadphaseProxies(NUM_RIGIDBODIES);
  param.workBuff = allocate(param.workBytes);
  param.numRigidBodies = NUM_RIGIDBODIES;
  param.offsetRigidStates = states;
  param.offsetCollidables = collidables;
  param.proxiesX = proxies[0];
  param.proxiesY = proxies[1];
  param.proxiesZ = proxies[2];
  param.proxiesXb = proxies[3];
  param.proxiesYb = proxies[4];
  param.proxiesZb = proxies[5];
  param.worldCenter = PfxVector3(0.0f);
  param.worldExtent = PfxVector3(100.0f);
  param.outOfWorldBehavior = behavior;
  PfxInt32 ret = pfxUpdateBroadphaseProxies(param, result, taskManager);
  SCE_PFX_UTIL_FREE(param.workBuff);
  return ret;
}

int main() {
  sceSysmoduleLoadModule(SCE_SYSMODULE_ULT);
  PfxUInt32 taskBytes = PfxPsp2TaskManager::getWorkBytes(3);
  void* taskBuff = allocate(taskBytes);
  PfxTaskManager* taskManager = new PfxPsp2TaskManager(3, 3, taskBuff, taskBytes);
  CHECK(taskManager->initialize() == SCE_PFX_OK);

  PfxShape shape;
  shape.reset();
  shape.setSphere(PfxSphere(1.0f));
  createShape(0, shape, PfxVector3(0.0f));
  shape.reset();
  shape.setBox(PfxBox(PfxVector3(1.0f)));
  createShape(1, shape, PfxVector3(10.0f, 0.0f, 0.0f));
  shape.reset();
  shape.setCapsule(PfxCapsule(1.0f, 0.5f));
  shape.setOffsetOrientation(PfxQuat::rotationZ(0.5f * SCE_PFX_PI));
  createShape(2, shape, PfxVector3(20.0f, 0.0f, 0.0f));
  shape.reset();
  shape.setCylinder(PfxCylinder(1.0f, 0.5f));
  createShape(3, shape, PfxVector3(30.0f, 0.0f, 0.0f));
  createShape(4, shape, PfxVector3(300.0f, 0.0f, 0.0f));

  PfxUpdateBroadphaseProxiesResult result;
  CHECK(updateProxies(result, 0, NULL) == SCE_PFX_OK);
  CHECK(result.numOutOfWorldProxies == 1);
  CHECK(states[4].getMotionType() == kPfxMotionTypeActive);
  CHECK(updateProxies(result, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION | SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY, taskManager) == SCE_PFX_OK);
  CHECK(result.numOutOfWorldProxies == 1);
  CHECK(states[4].getMotionType() == kPfxMotionTypeFixed);

  PfxRayCastParam param;
  param.offsetRigidStates = states;
  param.offsetCollidables = collidables;
  param.proxiesX = proxies[0];
  param.proxiesY = proxies[1];
  param.proxiesZ = proxies[2];
  param.proxiesXb = proxies[3];
  param.proxiesYb = proxies[4];
  param.proxiesZb = proxies[5];
  param.numProxies = NUM_RIGIDBODIES - result.numOutOfWorldProxies;
  param.rangeCenter = PfxVector3(0.0f);
  param.rangeExtent = PfxVector3(100.0f);

  PfxRayInput rays[5];
  PfxRayOutput hits[5], single;
  const PfxFloat heights[4] = {1.0f, 1.0f, 1.5f, 0.5f};
  for (int i = 0; i < 5; i++) {
    const PfxVector3 p1(10.0f * i, 10.0f, 0.0f), p2(10.0f * i, -10.0f, 0.0f);
    rays[i].reset();
    rays[i].m_startPosition = p1;
    rays[i].m_direction = p2 - p1;
  }
  pfxCastRays(rays, hits, 5, param, taskManager);
  for (int i = 0; i < 4; i++) {
    CHECK(hits[i].m_contactFlag);
    CHECK(hits[i].m_rigidBodyId == i);
    CHECK(std::fabs(hits[i].m_contactPoint[1] - heights[i]) < 1e-4f);
    CHECK(std::fabs(hits[i].m_contactNormal[1] - 1.0f) < 1e-4f);
    CHECK(std::fabs(hits[i].m_variable - (10.0f - heights[i]) / 20.0f) < 1e-5f);
    pfxCastSingleRay(rays[i], single, param);
    CHECK(single.m_contactFlag && single.m_variable == hits[i].m_variable);
  }
  CHECK(!hits[4].m_contactFlag);
  rays[0].m_direction *= 0.4f;  // too short
  pfxCastSingleRay(rays[0], single, param);
  CHECK(!single.m_contactFlag);
  states[1].setContactFilterSelf(2);
  updateProxies(result, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY, NULL);
  rays[1].m_contactFilterTarget = 1;
  pfxCastSingleRay(rays[1], single, param);
  CHECK(!single.m_contactFlag);

  static PfxSortData16 data[1000], work[1000];
  for (PfxUInt32 i = 0; i < 1000; i++) pfxSetKey(data[i], i * 7919 % 1000);
  CHECK(pfxParallelSort(data, 1000, work, sizeof(work), taskManager) == SCE_PFX_OK);
  for (PfxUInt32 i = 0; i < 1000; i++) CHECK(pfxGetKey(data[i]) == i);
  CHECK(pfxParallelSort(data, 1000, (char*)work + 4, sizeof(work), taskManager) == SCE_PFX_ERR_INVALID_ALIGN);

  CHECK(taskManager->finalize() == SCE_PFX_OK);
  delete taskManager;
  SCE_PFX_UTIL_FREE(taskBuff);
  sceSysmoduleUnloadModule(SCE_SYSMODULE_ULT);
  return failures == 0 ? 0 : 1;
}
