// Chapters 2 and 4: the application puts islands to sleep. Two stacks come to rest, fall asleep each on its own and are no
// longer moved; a ball wakes the one that it hits.
#include <cstring>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

#define NUM_RIGIDBODIES 8
#define NUM_CONTACTS 64

static PfxRigidState states[NUM_RIGIDBODIES];
static PfxRigidBody bodies[NUM_RIGIDBODIES];
static PfxCollidable collidables[NUM_RIGIDBODIES];
static PfxSolverBody solverBodies[NUM_RIGIDBODIES];
static PfxBroadphaseProxy proxies[NUM_RIGIDBODIES];
static PfxContactManifold contacts[NUM_CONTACTS];
static PfxBroadphasePair pairs[NUM_CONTACTS];
static PfxUInt32 numPairs = 0;
static bool wasThere[NUM_CONTACTS];  // in the step before
SCE_PFX_ALIGNED(128) static unsigned char islandBuff[32 * NUM_RIGIDBODIES];
SCE_PFX_ALIGNED(128) static unsigned char poolBuff[64 * 1024];
static const PfxFloat timeStep = 1.0f / 60.0f;

static void createBody(PfxUInt16 id, const PfxShape& shape, const PfxVector3& position, ePfxMotionType type) {
  collidables[id].reset();
  collidables[id].addShape(shape);
  collidables[id].finish();
  bodies[id].reset();
  bodies[id].setMass(1.0f);
  bodies[id].setInertia(pfxCalcInertiaBox(collidables[id].getHalf(), 1.0f));
  states[id].reset();
  states[id].setPosition(position);
  states[id].setMotionType(type);
  states[id].setUseSleep(1);
  states[id].setRigidBodyId(id);
}

// Contacts stay in the place of their pair: the same bodies, the same manifold.
static PfxUInt32 contactIdOf(PfxUInt32 a, PfxUInt32 b) { return SCE_PFX_MIN(a, b) * NUM_RIGIDBODIES + SCE_PFX_MAX(a, b); }

static void broadphase(PfxHeapManager& pool) {
  for (PfxUInt32 i = 0; i < NUM_RIGIDBODIES; i++) pfxUpdateBroadphaseProxy(proxies[i], states[i], collidables[i], PfxVector3(0.0f), PfxVector3(500.0f), 0);
  PfxUInt32 workBytes = sizeof(PfxBroadphaseProxy) * NUM_RIGIDBODIES;
  void* workBuff = pool.allocate(workBytes);
  CHECK(pfxParallelSort(proxies, NUM_RIGIDBODIES, workBuff, workBytes) == SCE_PFX_OK);
  PfxFindPairsParam param;
  param.workBytes = pfxGetWorkBytesOfFindPairs(NUM_CONTACTS);
  param.workBuff = pool.allocate(param.workBytes, PfxHeapManager::ALIGN128);
  param.pairBytes = pfxGetPairBytesOfFindPairs(NUM_CONTACTS);
  param.pairBuff = pool.allocate(param.pairBytes, PfxHeapManager::ALIGN128);
  param.proxies = proxies;
  param.numProxies = NUM_RIGIDBODIES;
  param.maxPairs = NUM_CONTACTS;
  param.axis = 0;
  PfxFindPairsResult result;
  CHECK(pfxFindPairs(param, result) == SCE_PFX_OK);
  bool isThere[NUM_CONTACTS] = {};
  numPairs = result.numPairs;
  for (PfxUInt32 i = 0; i < numPairs; i++) {
    PfxUInt16 a = pfxGetRigidBodyIdA(result.pairs[i]), b = pfxGetRigidBodyIdB(result.pairs[i]);
    PfxUInt32 id = contactIdOf(a, b);
    pairs[i] = result.pairs[i];
    pfxSetContactId(pairs[i], id);
    isThere[id] = true;
    if (wasThere[id]) continue;
    contacts[id].reset(a, b);
    states[a].wakeup();  // somebody new
    states[b].wakeup();
  }
  std::memcpy(wasThere, isThere, sizeof(wasThere));
  pool.clear();
}

static void collision() {
  PfxRefreshContactsParam refresh;
  refresh.contactPairs = pairs;
  refresh.numContactPairs = numPairs;
  refresh.offsetContactManifolds = contacts;
  refresh.offsetRigidStates = states;
  refresh.numRigidBodies = NUM_RIGIDBODIES;
  CHECK(pfxRefreshContacts(refresh) == SCE_PFX_OK);
  PfxDetectCollisionParam detect;
  detect.contactPairs = pairs;
  detect.numContactPairs = numPairs;
  detect.offsetContactManifolds = contacts;
  detect.offsetRigidStates = states;
  detect.offsetCollidables = collidables;
  detect.numRigidBodies = NUM_RIGIDBODIES;
  CHECK(pfxDetectCollision(detect) == SCE_PFX_OK);
}

static PfxIsland* generateIsland() {
  PfxGenerateIslandParam param;
  param.islandBytes = sizeof(islandBuff);
  param.islandBuff = islandBuff;
  param.pairs = pairs;
  param.numPairs = numPairs;
  param.numObjects = NUM_RIGIDBODIES;
  PfxGenerateIslandResult result;
  CHECK(pfxGenerateIsland(param, result) == SCE_PFX_OK);
  return result.island;
}

static void sleepOrWakeup(PfxIsland* island) {
  for (PfxUInt32 i = 0; i < pfxGetNumIslands(island); i++) {
    int numActive = 0, numSleep = 0, numCanSleep = 0;
    for (PfxIslandUnit* unit = pfxGetFirstUnitInIsland(island, i); unit != NULL; unit = pfxGetNextUnitInIsland(unit)) {
      const PfxRigidState& state = states[pfxGetUnitId(unit)];
      if (!(SCE_PFX_MOTION_MASK_CAN_SLEEP(state.getMotionType()))) continue;
      if (state.isAsleep()) {
        numSleep++;
      } else {
        numActive++;
        if (state.getSleepCount() > 180) numCanSleep++;
      }
    }
    for (PfxIslandUnit* unit = pfxGetFirstUnitInIsland(island, i); unit != NULL; unit = pfxGetNextUnitInIsland(unit)) {
      PfxRigidState& state = states[pfxGetUnitId(unit)];
      if (!(SCE_PFX_MOTION_MASK_CAN_SLEEP(state.getMotionType()))) continue;
      if (numActive > 0 && numSleep > 0) state.wakeup();                      // a mixed island wakes
      if (numSleep == 0 && numActive > 0 && numActive == numCanSleep) state.sleep();
    }
  }
}

static void constraintSolver(PfxHeapManager& pool) {
  PfxSetupSolverBodiesParam setup;
  setup.states = states;
  setup.bodies = bodies;
  setup.solverBodies = solverBodies;
  setup.numRigidBodies = NUM_RIGIDBODIES;
  CHECK(pfxSetupSolverBodies(setup) == SCE_PFX_OK);
  PfxSetupContactConstraintsParam contactParam;
  contactParam.contactPairs = pairs;
  contactParam.numContactPairs = numPairs;
  contactParam.offsetContactManifolds = contacts;
  contactParam.offsetRigidStates = states;
  contactParam.offsetRigidBodies = bodies;
  contactParam.offsetSolverBodies = solverBodies;
  contactParam.numRigidBodies = NUM_RIGIDBODIES;
  contactParam.timeStep = timeStep;
  contactParam.separateBias = 0.2f;
  CHECK(pfxSetupContactConstraints(contactParam) == SCE_PFX_OK);
  PfxSolveConstraintsParam param;
  param.workBytes = pfxGetWorkBytesOfSolveConstraints(NUM_RIGIDBODIES, numPairs, 0);
  param.workBuff = pool.allocate(param.workBytes);
  param.contactPairs = pairs;
  param.numContactPairs = numPairs;
  param.offsetContactManifolds = contacts;
  param.offsetRigidStates = states;
  param.offsetSolverBodies = solverBodies;
  param.numRigidBodies = NUM_RIGIDBODIES;
  param.iteration = 5;
  CHECK(pfxSolveConstraints(param) == SCE_PFX_OK);
  pool.deallocate(param.workBuff);
}

static void integrate() {
  PfxUpdateRigidStatesParam update;
  update.states = states;
  update.bodies = bodies;
  update.numRigidBodies = NUM_RIGIDBODIES;
  update.timeStep = timeStep;
  CHECK(pfxUpdateRigidStates(update) == SCE_PFX_OK);
  for (PfxUInt32 i = 0; i < NUM_RIGIDBODIES; i++) {
    if (lengthSqr(states[i].getLinearVelocity()) < 0.01f && lengthSqr(states[i].getAngularVelocity()) < 0.01f) {
      states[i].incrementSleepCount();
    } else {
      states[i].resetSleepCount();
    }
  }
}

static void simulate(int frames) {
  PfxHeapManager pool(poolBuff, sizeof(poolBuff));
  for (int frame = 0; frame < frames; frame++) {
    for (PfxUInt32 i = 0; i < NUM_RIGIDBODIES; i++)
      pfxApplyExternalForce(states[i], bodies[i], bodies[i].getMass() * PfxVector3(0.0f, -9.8f, 0.0f), PfxVector3(0.0f), timeStep);
    broadphase(pool);
    collision();
    sleepOrWakeup(generateIsland());
    constraintSolver(pool);
    integrate();
  }
}

int main() {
  PfxShape shape;
  shape.reset();
  shape.setBox(PfxBox(50.0f, 2.5f, 50.0f));
  createBody(0, shape, PfxVector3(0.0f, -2.5f, 0.0f), kPfxMotionTypeFixed);
  shape.reset();
  shape.setBox(PfxBox(0.5f, 0.5f, 0.5f));
  for (PfxUInt16 i = 1; i <= 6; i++) createBody(i, shape, PfxVector3(i <= 3 ? -5.0f : 5.0f, 0.5f + (i - 1) % 3, 0.0f), kPfxMotionTypeActive);
  shape.reset();
  shape.setSphere(PfxSphere(0.5f));
  createBody(7, shape, PfxVector3(0.0f, 0.5f, 20.0f), kPfxMotionTypeActive);
  states[7].setAngularDamping(0.9f);

  simulate(120);
  for (int i = 1; i < NUM_RIGIDBODIES; i++) CHECK(states[i].isAwake());
  simulate(240);
  for (int i = 1; i < NUM_RIGIDBODIES; i++) CHECK(states[i].isAsleep());
  const PfxVector3 top = states[3].getPosition(), other = states[6].getPosition();
  simulate(60);
  CHECK(length(states[3].getPosition() - top) == 0.0f);

  states[7].wakeup();
  states[7].setPosition(PfxVector3(-5.0f, 1.5f, 6.0f));
  states[7].setLinearVelocity(PfxVector3(0.0f, 3.0f, -12.0f));
  simulate(60);
  for (int i = 1; i <= 3; i++) CHECK(states[i].isAwake());
  for (int i = 4; i <= 6; i++) CHECK(states[i].isAsleep());
  CHECK(length(states[3].getPosition() - top) > 0.1f);
  CHECK(length(states[6].getPosition() - other) == 0.0f);
  return failures == 0 ? 0 : 1;
}
