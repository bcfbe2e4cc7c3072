// Chapters 3 and 4: the pipeline of the overview, written as its users write it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "compat/physics_effects.h"

using namespace sce::PhysicsEffects;

namespace {

struct Buffer {
  explicit Buffer(PfxUInt32 size) : bytes(size), data(std::aligned_alloc(16, SCE_PFX_BYTES_ALIGN16(size + 1))) {}
  ~Buffer() { std::free(data); }
  Buffer(const Buffer&) = delete;
  PfxUInt32 bytes;
  void* data;
};

// Bodies in the three arrays, pairs kept from step to step.
struct Scene {
  std::vector<PfxRigidState> states;
  std::vector<PfxRigidBody> bodies;
  std::vector<PfxCollidable> collidables;
  std::vector<PfxSolverBody> solver_bodies;
  std::vector<PfxJoint> joints;
  std::vector<PfxContactManifold> contacts;
  std::vector<PfxBroadphasePair> pairs;
  PfxTaskManager* tasks = nullptr;

  PfxUInt16 add(const PfxShape& shape, const PfxVector3& position, ePfxMotionType type, PfxFloat mass = 1.0f) {
    const PfxUInt16 id = static_cast<PfxUInt16>(states.size());
    states.emplace_back(), bodies.emplace_back(), collidables.emplace_back();
    collidables.back().addShape(shape);
    EXPECT_EQ(collidables.back().finish(), SCE_PFX_OK);
    bodies.back().setMass(mass);
    bodies.back().setInertia(pfxCalcInertiaBox(collidables.back().getHalf(), mass));
    states.back().setPosition(position);
    states.back().setMotionType(type);
    states.back().setRigidBodyId(id);
    return id;
  }
  PfxUInt16 addBox(const PfxVector3& half, const PfxVector3& position, ePfxMotionType type, PfxFloat mass = 1.0f) {
    PfxShape shape;
    shape.setBox(PfxBox(half));
    return add(shape, position, type, mass);
  }

  std::vector<PfxBroadphasePair> findPairs(int axis) {
    std::vector<PfxBroadphaseProxy> proxies(states.size()), sorted(states.size());
    for (size_t i = 0; i < states.size(); ++i)
      pfxUpdateBroadphaseProxy(proxies[i], states[i], collidables[i], PfxVector3(0.0f), PfxVector3(500.0f), axis);
    const PfxUInt32 n = static_cast<PfxUInt32>(proxies.size());
    EXPECT_EQ(pfxParallelSort(proxies.data(), n, sorted.data(), n * sizeof(PfxBroadphaseProxy)), SCE_PFX_OK);
    PfxFindPairsParam param;
    param.maxPairs = 4000;
    Buffer work(pfxGetWorkBytesOfFindPairs(param.maxPairs)), pair_buffer(pfxGetPairBytesOfFindPairs(param.maxPairs));
    param.workBuff = work.data, param.workBytes = work.bytes;
    param.pairBuff = pair_buffer.data, param.pairBytes = pair_buffer.bytes;
    param.proxies = proxies.data(), param.numProxies = n;
    param.axis = axis;
    PfxFindPairsResult result;
    EXPECT_EQ(pfxFindPairs(param, result), SCE_PFX_OK);
    return {result.pairs, result.pairs + result.numPairs};
  }

  void updatePairs() {
    std::vector<PfxBroadphasePair> current = findPairs(1);
    PfxDecomposePairsParam param;
    param.previousPairs = pairs.data(), param.numPreviousPairs = static_cast<PfxUInt32>(pairs.size());
    param.currentPairs = current.data(), param.numCurrentPairs = static_cast<PfxUInt32>(current.size());
    Buffer work(pfxGetWorkBytesOfDecomposePairs(param.numPreviousPairs, param.numCurrentPairs));
    Buffer out(pfxGetPairBytesOfDecomposePairs(param.numPreviousPairs, param.numCurrentPairs));
    param.workBuff = work.data, param.workBytes = work.bytes;
    param.pairBuff = out.data, param.pairBytes = out.bytes;
    PfxDecomposePairsResult result;
    EXPECT_EQ(pfxDecomposePairs(param, result), SCE_PFX_OK);
    for (PfxUInt32 i = 0; i < result.numOutNewPairs; ++i) {
      PfxBroadphasePair& pair = result.outNewPairs[i];
      pfxSetContactId(pair, static_cast<PfxUInt32>(contacts.size()));
      contacts.emplace_back().reset(pfxGetRigidBodyIdA(pair), pfxGetRigidBodyIdB(pair));
    }
    pairs.assign(result.outKeepPairs, result.outKeepPairs + result.numOutKeepPairs);
    pairs.insert(pairs.end(), result.outNewPairs, result.outNewPairs + result.numOutNewPairs);
    std::vector<PfxBroadphasePair> scratch(pairs.size());
    const PfxUInt32 n = static_cast<PfxUInt32>(pairs.size());
    pfxParallelSort(pairs.data(), n, scratch.data(), n * sizeof(PfxBroadphasePair));
  }

  void collide() {
    PfxRefreshContactsParam refresh;
    refresh.contactPairs = pairs.data(), refresh.numContactPairs = static_cast<PfxUInt32>(pairs.size());
    refresh.offsetContactManifolds = contacts.data();
    refresh.offsetRigidStates = states.data();
    refresh.numRigidBodies = static_cast<PfxUInt32>(states.size());
    EXPECT_EQ(pfxRefreshContacts(refresh, tasks), SCE_PFX_OK);
    PfxDetectCollisionParam detect;
    detect.contactPairs = pairs.data(), detect.numContactPairs = static_cast<PfxUInt32>(pairs.size());
    detect.offsetContactManifolds = contacts.data();
    detect.offsetRigidStates = states.data(), detect.offsetCollidables = collidables.data();
    detect.numRigidBody = static_cast<PfxUInt32>(states.size());
    EXPECT_EQ(pfxDetectCollision(detect, tasks), SCE_PFX_OK);
  }

  void solve(PfxFloat time_step, PfxUInt32 iterations) {
    const PfxUInt32 n = static_cast<PfxUInt32>(states.size());
    solver_bodies.resize(n);
    PfxSetupSolverBodiesParam setup;
    setup.states = states.data(), setup.bodies = bodies.data(), setup.solverBodies = solver_bodies.data();
    setup.numRigidBodies = n;
    EXPECT_EQ(pfxSetupSolverBodies(setup), SCE_PFX_OK);
    PfxSetupContactConstraintsParam contact;
    contact.contactPairs = pairs.data(), contact.numContactPairs = static_cast<PfxUInt32>(pairs.size());
    contact.offsetContactManifolds = contacts.data(), contact.offsetRigidStates = states.data();
    contact.offsetRigidBodies = bodies.data(), contact.offsetSolverBodies = solver_bodies.data();
    contact.numRigidBodies = n, contact.timeStep = time_step, contact.separateBias = 0.2f;
    EXPECT_EQ(pfxSetupContactConstraints(contact), SCE_PFX_OK);
    std::vector<PfxConstraintPair> joint_pairs(joints.size());
    for (PfxUInt32 i = 0; i < joints.size(); ++i)
      pfxUpdateJointPairs(joint_pairs[i], i, joints[i], states[joints[i].m_rigidBodyIdA], states[joints[i].m_rigidBodyIdB]);
    PfxSetupJointConstraintsParam joint;
    joint.jointPairs = joint_pairs.data(), joint.numJointPairs = static_cast<PfxUInt32>(joints.size());
    joint.offsetJoints = joints.data(), joint.offsetRigidStates = states.data();
    joint.offsetRigidBodies = bodies.data(), joint.offsetSolverBodies = solver_bodies.data();
    joint.numRigidBodies = n, joint.timeStep = time_step;
    EXPECT_EQ(pfxSetupJointConstraints(joint), SCE_PFX_OK);
    PfxSolveConstraintsParam param;
    Buffer work(pfxGetWorkBytesOfSolveConstraints(n, contact.numContactPairs, joint.numJointPairs));
    param.workBuff = work.data, param.workBytes = work.bytes;
    param.contactPairs = pairs.data(), param.numContactPairs = contact.numContactPairs;
    param.offsetContactManifolds = contacts.data();
    param.jointPairs = joint_pairs.data(), param.numJointPairs = joint.numJointPairs, param.offsetJoints = joints.data();
    param.offsetRigidStates = states.data(), param.offsetSolverBodies = solver_bodies.data();
    param.numRigidBodies = n, param.iteration = iterations;
    EXPECT_EQ(pfxSolveConstraints(param), SCE_PFX_OK);
  }

  void step(PfxFloat time_step = 0.016f, PfxUInt32 iterations = 10) {
    const PfxUInt32 n = static_cast<PfxUInt32>(states.size());
    for (PfxUInt32 i = 0; i < n; ++i)
      pfxApplyExternalForce(states[i], bodies[i], bodies[i].getMass() * PfxVector3(0.0f, -9.8f, 0.0f), PfxVector3(0.0f), time_step);
    updatePairs();
    collide();
    solve(time_step, iterations);
    PfxUpdateRigidStatesParam update;
    update.states = states.data(), update.bodies = bodies.data();
    update.numRigidBodies = n, update.timeStep = time_step;
    EXPECT_EQ(pfxUpdateRigidStates(update), SCE_PFX_OK);
  }
};

TEST(CompatPipeline, ABoxFallsAndRestsOnTheGround) {
  Scene scene;
  scene.addBox(PfxVector3(10, 1, 10), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 3, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 300; ++i) scene.step();
  EXPECT_NEAR(scene.states[1].getPosition()[1], 0.5f, 0.005f);  // the solver leaves a millimetre of overlap alone
  EXPECT_LT(length(scene.states[1].getLinearVelocity()), 0.01f);
  EXPECT_EQ(scene.states[0].getPosition()[1], -1.0f);
  EXPECT_TRUE(scene.states[1].isAwake());
}

TEST(CompatPipeline, AColumnOfFiveBoxesStands) {
  Scene scene;
  scene.addBox(PfxVector3(10, 1, 10), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  for (int i = 0; i < 5; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f + i, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 600; ++i) scene.step();
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(scene.states[1 + i].getPosition()[1], 0.5f + i, 0.02f) << i;
}

TEST(CompatPipeline, EveryAxisFindsThePairsThatBruteForceFinds) {
  Scene scene;
  PfxUInt32 random = 1;
  const auto next = [&random] { return random = random * 1664525u + 1013904223u, static_cast<PfxFloat>(random >> 8) / 16777216.0f; };
  for (int i = 0; i < 300; ++i) {
    const PfxFloat x = next() * 20.0f, y = next() * 20.0f, z = next() * 20.0f;
    scene.addBox(PfxVector3(0.7f), PfxVector3(x, y, z), kPfxMotionTypeActive);
  }
  std::vector<PfxUInt32> expected;
  for (PfxUInt32 b = 0; b < 300; ++b)
    for (PfxUInt32 a = 0; a < b; ++a)
      if (maxElem(absPerElem(scene.states[a].getPosition() - scene.states[b].getPosition())) < 1.4f)
        expected.push_back(pfxCalcUniqueKey(a, b));
  ASSERT_GT(expected.size(), 50u);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<PfxUInt32> keys;
    for (const PfxBroadphasePair& pair : scene.findPairs(axis)) keys.push_back(pfxGetKey(pair));
    EXPECT_EQ(keys, expected) << axis;
  }
}

TEST(CompatPipeline, ABallJointHoldsASwingingBox) {
  Scene scene;
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 5, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(2, 5, 0), kPfxMotionTypeActive);
  PfxBallJointInitParam param;
  param.anchorPoint = PfxVector3(0, 5, 0);
  scene.joints.emplace_back();
  ASSERT_EQ(pfxInitializeBallJoint(scene.joints[0], scene.states[0], scene.states[1], param), SCE_PFX_OK);
  PfxFloat lowest = 5.0f;
  for (int i = 0; i < 200; ++i) {
    scene.step();
    EXPECT_NEAR(length(scene.states[1].getPosition() - param.anchorPoint), 2.0f, 0.05f);
    lowest = SCE_PFX_MIN(lowest, scene.states[1].getPosition()[1]);
  }
  EXPECT_LT(lowest, 3.1f);
}

TEST(CompatPipeline, AHingeStopsAtItsLimit) {
  Scene scene;
  scene.addBox(PfxVector3(0.1f), PfxVector3(0, 5, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(1, 5, 0), kPfxMotionTypeActive);
  PfxHingeJointInitParam param;
  param.anchorPoint = PfxVector3(0, 5, 0);
  param.axis = PfxVector3(0, 0, 1);
  param.lowerAngle = -0.5f, param.upperAngle = 0.5f;
  scene.joints.emplace_back();
  ASSERT_EQ(pfxInitializeHingeJoint(scene.joints[0], scene.states[0], scene.states[1], param), SCE_PFX_OK);
  for (int i = 0; i < 300; ++i) {
    scene.step();
    // The overshoot that the documented limits allow is 0.12 rad.
    EXPECT_GT(scene.states[1].getPosition()[1] - param.anchorPoint[1], -std::sin(0.5f + 0.12f)) << i;
  }
  const PfxVector3 arm = scene.states[1].getPosition() - param.anchorPoint;
  EXPECT_NEAR(arm[1], -std::sin(0.5f), 0.02f);
}

TEST(CompatPipeline, MotionTypesDecideWhoIsMoved) {
  const ePfxMotionType others[] = {kPfxMotionTypeFixed, kPfxMotionTypeKeyframe, kPfxMotionTypeOneWay, kPfxMotionTypeTrigger};
  const bool pushes[] = {true, true, false, false};
  for (int k = 0; k < 4; ++k) {
    Scene scene;
    scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0, 0), others[k]);
    const PfxUInt16 id = scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.95f, 0), kPfxMotionTypeActive);
    scene.updatePairs();
    scene.collide();
    ASSERT_EQ(scene.pairs.size(), 1u);
    EXPECT_GT(scene.contacts[0].getNumContacts(), 0);
    EXPECT_NEAR(scene.contacts[0].getContactPoint(0).m_distance, -0.05f, 1e-4f);
    scene.solve(0.016f, 5);
    EXPECT_EQ(length(scene.states[id].getLinearVelocity()) > 0.01f, pushes[k]) << k;
    EXPECT_EQ(length(scene.states[0].getLinearVelocity()) > 0.01f, others[k] == kPfxMotionTypeOneWay) << k;
  }
}

TEST(CompatPipeline, AFifthContactPointLeavesTheDeepestAndTheLargestArea) {
  PfxContactManifold manifold;
  const PfxVector3 n(0, 1, 0);
  const PfxFloat corners[5][2] = {{-1, -1}, {1, -1}, {0.9f, 0.9f}, {-1, 1}, {1, 1}};
  for (int i = 0; i < 5; ++i) {
    const PfxPoint3 p(corners[i][0], 0, corners[i][1]);
    manifold.addContactPoint(i == 0 ? -0.1f : -0.01f, n, p, p);
  }
  ASSERT_EQ(manifold.getNumContacts(), 4);
  bool deepest = false;
  for (int i = 0; i < 4; ++i) {
    const PfxContactPoint& p = manifold.getContactPoint(i);
    deepest |= p.m_distance == -0.1f;
    EXPECT_NE(p.m_localPointA[0], 0.9f);
  }
  EXPECT_TRUE(deepest);
}

TEST(CompatPipeline, ShortAndMissingBuffersAreErrors) {
  PfxFindPairsParam param;
  PfxFindPairsResult result;
  EXPECT_EQ(pfxFindPairs(param, result), SCE_PFX_ERR_INVALID_VALUE);
  Buffer work(64), pairs(64);
  param.workBuff = work.data, param.workBytes = work.bytes;
  param.pairBuff = pairs.data, param.pairBytes = pairs.bytes;
  param.maxPairs = 100;
  EXPECT_EQ(pfxFindPairs(param, result), SCE_PFX_ERR_OUT_OF_BUFFER);
  param.workBuff = static_cast<char*>(work.data) + 4;
  EXPECT_EQ(pfxFindPairs(param, result), SCE_PFX_ERR_INVALID_ALIGN);
  PfxSolveConstraintsParam solve;
  EXPECT_EQ(pfxSolveConstraints(solve), SCE_PFX_ERR_INVALID_VALUE);
}

TEST(CompatShapes, ACollidableTakesAsManyShapesAsItWasGivenPlacesFor) {
  PfxShape shapes[3], sphere;
  sphere.setSphere(PfxSphere(0.5f));
  const PfxUInt16 ids[] = {0, 1, 2};
  PfxCollidable collidable;
  ASSERT_EQ(collidable.reset(shapes, ids, 3), SCE_PFX_OK);
  for (int i = 0; i < 3; ++i) {
    sphere.setOffsetPosition(PfxVector3(static_cast<PfxFloat>(i), 0, 0));
    EXPECT_EQ(collidable.addShape(sphere), SCE_PFX_OK);
  }
  EXPECT_EQ(collidable.addShape(sphere), SCE_PFX_ERR_OUT_OF_RANGE);
  ASSERT_EQ(collidable.finish(), SCE_PFX_OK);
  EXPECT_FLOAT_EQ(collidable.getCenter()[0], 1.0f);
  EXPECT_FLOAT_EQ(collidable.getHalf()[0], 1.5f);
  EXPECT_EQ(collidable.reset(shapes, ids, 65), SCE_PFX_ERR_OUT_OF_RANGE);
}

}  // namespace
