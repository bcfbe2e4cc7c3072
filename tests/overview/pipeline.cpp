// Chapters 2 to 4: bodies, joints, and the five stages with contacts that are kept from step to step, in two alternating
// arrays of pairs.
#include <cmath>
#include <cstring>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

#define NUM_RIGIDBODIES 8
#define NUM_JOINTS 1
#define NUM_CONTACTS 64

static PfxRigidState states[NUM_RIGIDBODIES];
static PfxRigidBody bodies[NUM_RIGIDBODIES];
static PfxCollidable collidables[NUM_RIGIDBODIES];
static PfxSolverBody solverBodies[NUM_RIGIDBODIES];
static PfxBroadphaseProxy proxies[NUM_RIGIDBODIES];
static PfxJoint joints[NUM_JOINTS];
static PfxConstraintPair jointPairs[NUM_JOINTS];
static PfxContactManifold contacts[NUM_CONTACTS];
static PfxUInt32 contactIdPool[NUM_CONTACTS];
static PfxUInt32 numContactIdPool = 0, numContacts = 0;
static PfxBroadphasePair pairs[2][NUM_CONTACTS];
static PfxUInt32 numPairs[2] = {0, 0};
static int pairSwap = 0;
static const PfxFloat timeStep = 0.016f;
static PfxShape compoundShapes[3];
static PfxUInt16 compoundShapeIds[3] = {0, 1, 2};

SCE_PFX_ALIGNED(128) static unsigned char poolBuff[256 * 1024];
static PfxHeapManager pool(poolBuff, sizeof(poolBuff));
static PfxPerfCounter perf;

static void placeBody(PfxUInt16 id, const PfxVector3& position, ePfxMotionType type, PfxFloat mass) {
  bodies[id].reset();
  bodies[id].setMass(mass);
  bodies[id].setInertia(pfxCalcInertiaBox(collidables[id].getHalf(), mass));
  bodies[id].setFriction(0.6f);
  bodies[id].setRestitution(0.0f);
  states[id].reset();
  states[id].setPosition(position);
  states[id].setOrientation(PfxQuat::identity());
  states[id].setMotionType(type);
  states[id].setRigidBodyId(id);
}

static void createBox(PfxUInt16 id, const PfxVector3& half, const PfxVector3& position, ePfxMotionType type) {
  PfxBox box(half);
  PfxShape shape;
  shape.reset();
  shape.setBox(box);
  collidables[id].reset();
  collidables[id].addShape(shape);
  collidables[id].finish();
  placeBody(id, position, type, 1.0f);
}

static void createCompound(PfxUInt16 id, const PfxVector3& position) {
  collidables[id].reset(compoundShapes, compoundShapeIds, 3);
  PfxShape shape;
  shape.reset();
  shape.setBox(PfxBox(PfxVector3(0.5f, 0.5f, 1.5f)));
  shape.setOffsetPosition(PfxVector3(-2.0f, 0.0f, 0.0f));
  CHECK(collidables[id].addShape(shape) == SCE_PFX_OK);
  shape.setOffsetPosition(PfxVector3(2.0f, 0.0f, 0.0f));
  CHECK(collidables[id].addShape(shape) == SCE_PFX_OK);
  shape.reset();
  shape.setCapsule(PfxCapsule(1.5f, 0.5f));
  CHECK(collidables[id].addShape(shape) == SCE_PFX_OK);
  CHECK(collidables[id].addShape(shape) != SCE_PFX_OK);
  collidables[id].finish();
  CHECK(std::fabs(collidables[id].getHalf()[0] - 2.5f) < 1e-5f);
  placeBody(id, position, kPfxMotionTypeActive, 3.0f);
}

static void broadphase() {
  pairSwap = 1 - pairSwap;
  PfxUInt32& numPreviousPairs = numPairs[1 - pairSwap];
  PfxUInt32& numCurrentPairs = numPairs[pairSwap];
  PfxBroadphasePair* previousPairs = pairs[1 - pairSwap];
  PfxBroadphasePair* currentPairs = pairs[pairSwap];

  PfxVector3 s(0.0f), s2(0.0f);
  for (int i = 0; i < NUM_RIGIDBODIES; i++) {
    PfxVector3 c = states[i].getPosition();
    s += c;
    s2 += mulPerElem(c, c);
  }
  PfxVector3 v = s2 - mulPerElem(s, s) / (PfxFloat)NUM_RIGIDBODIES;
  int axis = 0;
  if (v[1] > v[0]) axis = 1;
  if (v[2] > v[axis]) axis = 2;

  for (PfxUInt32 i = 0; i < NUM_RIGIDBODIES; i++) {
    CHECK(pfxUpdateBroadphaseProxy(proxies[i], states[i], collidables[i], PfxVector3(0.0f), PfxVector3(500.0f), axis) == SCE_PFX_OK);
  }
  {
    PfxUInt32 workBytes = sizeof(PfxBroadphaseProxy) * NUM_RIGIDBODIES;
    void* workBuff = pool.allocate(workBytes);
    CHECK(pfxParallelSort(proxies, NUM_RIGIDBODIES, workBuff, workBytes) == SCE_PFX_OK);
    pool.deallocate(workBuff);
  }
  {
    PfxFindPairsParam param;
    param.workBytes = pfxGetWorkBytesOfFindPairs(NUM_CONTACTS);
    param.workBuff = pool.allocate(param.workBytes);
    param.pairBytes = pfxGetPairBytesOfFindPairs(NUM_CONTACTS);
    param.pairBuff = pool.allocate(param.pairBytes);
    param.proxies = proxies;
    param.numProxies = NUM_RIGIDBODIES;
    param.maxPairs = NUM_CONTACTS;
    param.axis = axis;
    PfxFindPairsResult result;
    CHECK(pfxFindPairs(param, result) == SCE_PFX_OK);
    std::memcpy(currentPairs, result.pairs, sizeof(PfxBroadphasePair) * result.numPairs);
    numCurrentPairs = result.numPairs;
    pool.deallocate(param.pairBuff);
    pool.deallocate(param.workBuff);
  }
  {
    PfxDecomposePairsParam param;
    param.pairBytes = pfxGetPairBytesOfDecomposePairs(numPreviousPairs, numCurrentPairs);
    param.pairBuff = pool.allocate(param.pairBytes);
    param.workBytes = pfxGetWorkBytesOfDecomposePairs(numPreviousPairs, numCurrentPairs);
    param.workBuff = pool.allocate(param.workBytes);
    param.previousPairs = previousPairs;
    param.numPreviousPairs = numPreviousPairs;
    param.currentPairs = currentPairs;
    param.numCurrentPairs = numCurrentPairs;
    PfxDecomposePairsResult result;
    CHECK(pfxDecomposePairs(param, result) == SCE_PFX_OK);
    for (PfxUInt32 i = 0; i < result.numOutRemovePairs; i++) contactIdPool[numContactIdPool++] = pfxGetContactId(result.outRemovePairs[i]);
    for (PfxUInt32 i = 0; i < result.numOutNewPairs; i++) {
      PfxUInt32 cId = numContactIdPool > 0 ? contactIdPool[--numContactIdPool] : numContacts++;
      pfxSetContactId(result.outNewPairs[i], cId);
      contacts[cId].reset(pfxGetRigidBodyIdA(result.outNewPairs[i]), pfxGetRigidBodyIdB(result.outNewPairs[i]));
    }
    numCurrentPairs = 0;
    for (PfxUInt32 i = 0; i < result.numOutKeepPairs; i++) currentPairs[numCurrentPairs++] = result.outKeepPairs[i];
    for (PfxUInt32 i = 0; i < result.numOutNewPairs; i++) currentPairs[numCurrentPairs++] = result.outNewPairs[i];
    pool.deallocate(param.workBuff);
    pool.deallocate(param.pairBuff);
  }
  {
    PfxUInt32 workBytes = sizeof(PfxBroadphasePair) * NUM_CONTACTS;
    void* workBuff = pool.allocate(workBytes);
    CHECK(pfxParallelSort(currentPairs, numCurrentPairs, workBuff, workBytes) == SCE_PFX_OK);
    pool.deallocate(workBuff);
  }
}

static void collision() {
  PfxRefreshContactsParam refresh;
  refresh.contactPairs = pairs[pairSwap];
  refresh.numContactPairs = numPairs[pairSwap];
  refresh.offsetContactManifolds = contacts;
  refresh.offsetRigidStates = states;
  refresh.numRigidBody = NUM_RIGIDBODIES;
  CHECK(pfxRefreshContacts(refresh) == SCE_PFX_OK);
  PfxDetectCollisionParam detect;
  detect.contactPairs = pairs[pairSwap];
  detect.numContactPairs = numPairs[pairSwap];
  detect.offsetContactManifolds = contacts;
  detect.offsetRigidStates = states;
  detect.offsetCollidables = collidables;
  detect.numRigidBodies = NUM_RIGIDBODIES;
  CHECK(pfxDetectCollision(detect) == SCE_PFX_OK);
}

static void constraintSolver() {
  PfxSetupSolverBodiesParam setup;
  setup.states = states;
  setup.bodies = bodies;
  setup.solverBodies = solverBodies;
  setup.numRigidBodies = NUM_RIGIDBODIES;
  CHECK(pfxSetupSolverBodies(setup) == SCE_PFX_OK);

  PfxSetupContactConstraintsParam contactParam;
  contactParam.contactPairs = pairs[pairSwap];
  contactParam.numContactPairs = numPairs[pairSwap];
  contactParam.offsetContactManifolds = contacts;
  contactParam.offsetRigidStates = states;
  contactParam.offsetRigidBodies = bodies;
  contactParam.offsetSolverBodies = solverBodies;
  contactParam.numRigidBodies = NUM_RIGIDBODIES;
  contactParam.timeStep = timeStep;
  contactParam.separateBias = 0.2f;
  CHECK(pfxSetupContactConstraints(contactParam) == SCE_PFX_OK);

  for (PfxUInt32 i = 0; i < NUM_JOINTS; i++) {
    pfxUpdateJointPairs(jointPairs[i], i, joints[i], states[joints[i].m_rigidBodyIdA], states[joints[i].m_rigidBodyIdB]);
  }
  PfxSetupJointConstraintsParam jointParam;
  jointParam.jointPairs = jointPairs;
  jointParam.numJointPairs = NUM_JOINTS;
  jointParam.offsetJoints = joints;
  jointParam.offsetRigidStates = states;
  jointParam.offsetRigidBodies = bodies;
  jointParam.offsetSolverBodies = solverBodies;
  jointParam.numRigidBodies = NUM_RIGIDBODIES;
  jointParam.timeStep = timeStep;
  CHECK(pfxSetupJointConstraints(jointParam) == SCE_PFX_OK);

  PfxSolveConstraintsParam param;
  param.workBytes = pfxGetWorkBytesOfSolveConstraints(NUM_RIGIDBODIES, numPairs[pairSwap], NUM_JOINTS);
  param.workBuff = pool.allocate(param.workBytes);
  param.contactPairs = pairs[pairSwap];
  param.numContactPairs = numPairs[pairSwap];
  param.offsetContactManifolds = contacts;
  param.jointPairs = jointPairs;
  param.numJointPairs = NUM_JOINTS;
  param.offsetJoints = joints;
  param.offsetRigidStates = states;
  param.offsetSolverBodies = solverBodies;
  param.numRigidBodies = NUM_RIGIDBODIES;
  param.iteration = 5;
  CHECK(pfxSolveConstraints(param) == SCE_PFX_OK);
  pool.deallocate(param.workBuff);
}

int main() {
  createBox(0, PfxVector3(50.0f, 2.5f, 50.0f), PfxVector3(0.0f, -2.5f, 0.0f), kPfxMotionTypeFixed);
  for (PfxUInt16 i = 1; i < 6; i++) createBox(i, PfxVector3(0.5f), PfxVector3(0.0f, 0.5f + 1.0f * (i - 1), 0.0f), kPfxMotionTypeActive);
  createCompound(6, PfxVector3(20.0f, 1.0f, 0.0f));
  createBox(7, PfxVector3(0.5f), PfxVector3(-20.0f, 5.0f, 0.0f), kPfxMotionTypeActive);

  PfxBallJointInitParam jparam;
  jparam.anchorPoint = PfxPoint3(-22.0f, 5.0f, 0.0f) - PfxPoint3(0.0f);
  CHECK(pfxInitializeBallJoint(joints[0], states[0], states[7], jparam) == SCE_PFX_OK);
  CHECK(joints[0].m_type == kPfxJointBall);
  CHECK(joints[0].m_constraints[0].m_lock == SCE_PFX_JOINT_LOCK_FIX);
  CHECK(joints[0].m_constraints[3].m_lock == SCE_PFX_JOINT_LOCK_FREE);

  PfxFloat stretch = 0.0f;
  for (int frame = 0; frame < 300; frame++) {
    for (int i = 1; i < NUM_RIGIDBODIES; i++) {
      PfxVector3 gravity = bodies[i].getMass() * PfxVector3(0.0f, -9.8f, 0.0f);
      CHECK(pfxApplyExternalForce(states[i], bodies[i], gravity, PfxVector3(0.0f), timeStep) == SCE_PFX_OK);
    }
    perf.resetCount();
    perf.countBegin("broadphase");
    broadphase();
    perf.countEnd();
    perf.countBegin("collision");
    collision();
    perf.countEnd();
    perf.countBegin("solver");
    constraintSolver();
    perf.countEnd();
    CHECK(pool.getAllocated() == 0);
    PfxUpdateRigidStatesParam update;
    update.states = states;
    update.bodies = bodies;
    update.numRigidBodies = NUM_RIGIDBODIES;
    update.timeStep = timeStep;
    CHECK(pfxUpdateRigidStates(update) == SCE_PFX_OK);
    PfxFloat r = length(states[7].getPosition() - PfxVector3(-22.0f, 5.0f, 0.0f));
    stretch = SCE_PFX_MAX(stretch, std::fabs(r - 2.0f));
  }
  for (int i = 1; i < 6; i++) CHECK(length(states[i].getPosition() - PfxVector3(0.0f, 0.5f + 1.0f * (i - 1), 0.0f)) < 0.05f);
  CHECK(std::fabs(states[6].getPosition()[1] - 0.5f) < 0.01f);
  CHECK(stretch < 0.02f);
  CHECK(perf.getCountTime(0) > 0.0f && perf.getCountTime(2) > 0.0f && perf.getCountTime(4) > 0.0f);
  perf.printCount();
  std::printf("a column of five boxes ends %.2f mm off, the pendulum is stretched by %.2f mm at most\n",
              1e3 * (double)length(states[5].getPosition() - PfxVector3(0.0f, 4.5f, 0.0f)), 1e3 * (double)stretch);
  return failures == 0 ? 0 : 1;
}
