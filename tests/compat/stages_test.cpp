// Chapters 4 and 10: each stage alone, its buffers and errors, and the table of motion types.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "tests/compat/scene.h"

using namespace compat_tests;

namespace {

constexpr ePfxMotionType kTypes[] = {kPfxMotionTypeFixed, kPfxMotionTypeActive, kPfxMotionTypeKeyframe, kPfxMotionTypeOneWay,
                                     kPfxMotionTypeTrigger};

TEST(CompatForce, GravityIsTheSameForEveryMassAndForNothingThatIsNotMoved) {
  for (const ePfxMotionType type : kTypes)
    for (const PfxFloat mass : {0.5f, 1.0f, 100.0f}) {
      PfxRigidState state;
      PfxRigidBody body;
      state.setMotionType(type);
      body.setMass(mass);
      EXPECT_EQ(pfxApplyExternalForce(state, body, body.getMass() * PfxVector3(0, -9.8f, 0), PfxVector3(0.0f), 0.016f), SCE_PFX_OK);
      const bool moved = type == kPfxMotionTypeActive || type == kPfxMotionTypeOneWay;
      EXPECT_FLOAT_EQ(state.getLinearVelocity()[1], moved ? -9.8f * 0.016f : 0.0f);
    }
}

TEST(CompatForce, SleepersStayAsleepAndWrongValuesAreErrors) {
  PfxRigidState state;
  PfxRigidBody body;
  state.sleep();
  pfxApplyExternalForce(state, body, PfxVector3(1.0f), PfxVector3(1.0f), 0.016f);
  EXPECT_TRUE(state.isAsleep());
  EXPECT_EQ(length(state.getLinearVelocity()), 0.0f);
  state.wakeup();
  const PfxFloat nan = std::numeric_limits<PfxFloat>::quiet_NaN();
  EXPECT_EQ(pfxApplyExternalForce(state, body, PfxVector3(nan), PfxVector3(0.0f), 0.016f), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(pfxApplyExternalForce(state, body, PfxVector3(1.0f), PfxVector3(0.0f), 0.0f), SCE_PFX_ERR_INVALID_VALUE);
  body.setInertia(pfxCalcInertiaSphere(1.0f, 1.0f));
  pfxApplyExternalForce(state, body, PfxVector3(0.0f), PfxVector3(0, 0.4f, 0), 0.5f);
  EXPECT_NEAR(state.getAngularVelocity()[1], 0.5f, 1e-6f);
}

TEST(CompatProxies, OneProxyAloneIsTheSameAsInTheArray) {
  Scene scene;
  scene.addBox(PfxVector3(0.5f), PfxVector3(1, 2, 3), kPfxMotionTypeActive);
  PfxBroadphaseProxy alone[6], array[6], work[6];
  pfxUpdateBroadphaseProxy(alone[0], alone[1], alone[2], alone[3], alone[4], alone[5], scene.states[0], scene.collidables[0],
                           PfxVector3(0.0f), PfxVector3(500.0f));
  PfxUpdateBroadphaseProxiesParam param;
  param.workBuff = work, param.workBytes = pfxGetWorkBytesOfUpdateBroadphaseProxies(1);
  param.numRigidBody = 1;
  param.offsetRigidStates = scene.states.data(), param.offsetCollidables = scene.collidables.data();
  param.proxiesX = array, param.proxiesY = array + 1, param.proxiesZ = array + 2;
  param.proxiesXb = array + 3, param.proxiesYb = array + 4, param.proxiesZb = array + 5;
  PfxUpdateBroadphaseProxiesResult result;
  ASSERT_EQ(pfxUpdateBroadphaseProxies(param, result), SCE_PFX_OK);
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 8; ++k) EXPECT_EQ(alone[i].get32(k), array[i].get32(k)) << i << " " << k;
}

TEST(CompatProxies, BodiesOutsideAreReportedFixedOrLeftOut) {
  const PfxUInt32 fix = SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION, remove = SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY;
  for (const PfxUInt32 behavior : {0u, fix, remove, fix | remove}) {
    Scene scene;
    for (const PfxFloat x : {0.0f, 600.0f, 3.0f}) scene.addBox(PfxVector3(0.5f), PfxVector3(x, 0, 0), kPfxMotionTypeActive);
    PfxBroadphaseProxy proxy, x[3], work[3];
    EXPECT_EQ(pfxUpdateBroadphaseProxy(proxy, scene.states[1], scene.collidables[1], PfxVector3(0.0f), PfxVector3(500.0f), 0),
              SCE_PFX_ERR_OUT_OF_WORLD);
    EXPECT_EQ(pfxGetRigidBodyId(proxy), 1);  // made all the same
    PfxUpdateBroadphaseProxiesParam param;
    EXPECT_EQ(param.outOfWorldBehavior, 0u);
    param.workBuff = work, param.workBytes = sizeof work, param.numRigidBodies = 3;
    param.offsetRigidStates = scene.states.data(), param.offsetCollidables = scene.collidables.data();
    param.proxiesX = x, param.outOfWorldBehavior = behavior;
    PfxUpdateBroadphaseProxiesResult result;
    ASSERT_EQ(pfxUpdateBroadphaseProxies(param, result), SCE_PFX_OK);
    EXPECT_EQ(result.numOutOfWorldProxies, 1);
    EXPECT_EQ(result.numProxies, behavior & remove ? 2 : 3);
    EXPECT_EQ(scene.states[1].getMotionType(), behavior & fix ? kPfxMotionTypeFixed : kPfxMotionTypeActive);
    if (behavior & remove) {
      EXPECT_EQ(pfxGetRigidBodyId(x[1]), 2);
    }
  }
}

TEST(CompatPairs, FiltersDecideWhoMeets) {
  for (PfxUInt32 self = 0; self < 4; ++self)
    for (PfxUInt32 target = 0; target < 4; ++target) {
      Scene scene;
      for (int i = 0; i < 2; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(0.0f), kPfxMotionTypeActive);
      scene.states[0].setContactFilterSelf(1), scene.states[0].setContactFilterTarget(2);
      scene.states[1].setContactFilterSelf(self), scene.states[1].setContactFilterTarget(target);
      EXPECT_EQ(scene.findPairs(0).size(), (self & 2u) && (target & 1u) ? 1u : 0u);
    }
}

TEST(CompatPairs, TooManyAreAnErrorAndALargerBufferFindsAll) {
  Scene scene;
  for (int i = 0; i < 10; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(0.0f), kPfxMotionTypeActive);
  std::vector<PfxBroadphaseProxy> proxies(10);
  for (PfxUInt32 i = 0; i < 10; ++i)
    pfxUpdateBroadphaseProxy(proxies[i], scene.states[i], scene.collidables[i], PfxVector3(0.0f), PfxVector3(500.0f), 0);
  for (const PfxUInt32 most : {44u, 45u}) {
    Buffer work(pfxGetWorkBytesOfFindPairs(most)), pairs(pfxGetPairBytesOfFindPairs(most));
    PfxFindPairsParam param;
    param.workBuff = work.data, param.workBytes = work.bytes, param.pairBuff = pairs.data, param.pairBytes = pairs.bytes;
    param.proxies = proxies.data(), param.numProxies = 10, param.maxPairs = most, param.axis = 0;
    PfxFindPairsResult result;
    EXPECT_EQ(pfxFindPairs(param, result), most == 44 ? SCE_PFX_ERR_OUT_OF_MAX_PAIRS : SCE_PFX_OK);
    EXPECT_EQ(result.numPairs, most == 44 ? 0u : 45u);
    for (PfxUInt32 i = 1; i < result.numPairs; ++i) EXPECT_LT(pfxGetKey(result.pairs[i - 1]), pfxGetKey(result.pairs[i]));
  }
}

TEST(CompatPairs, DecompositionIsSetArithmetic) {
  const auto list = [](std::initializer_list<PfxUInt32> keys) {
    std::vector<PfxBroadphasePair> pairs;
    for (const PfxUInt32 key : keys) {
      pairs.emplace_back();
      pairs.back() = {};
      pfxSetKey(pairs.back(), key);
      pfxSetContactId(pairs.back(), key * 10);
    }
    return pairs;
  };
  std::vector<PfxBroadphasePair> prev = list({1, 2, 5, 9}), cur = list({2, 3, 4, 9, 11});
  for (PfxBroadphasePair& pair : cur) pfxSetContactId(pair, 0);
  PfxDecomposePairsParam param;
  param.previousPairs = prev.data(), param.numPreviousPairs = 4, param.currentPairs = cur.data(), param.numCurrentPairs = 5;
  Buffer work(pfxGetWorkBytesOfDecomposePairs(4, 5)), out(pfxGetPairBytesOfDecomposePairs(4, 5));
  param.workBuff = work.data, param.workBytes = work.bytes, param.pairBuff = out.data, param.pairBytes = out.bytes;
  PfxDecomposePairsResult result;
  ASSERT_EQ(pfxDecomposePairs(param, result), SCE_PFX_OK);
  const auto keys = [](const PfxBroadphasePair* p, PfxUInt32 n) {
    std::vector<PfxUInt32> k;
    for (PfxUInt32 i = 0; i < n; ++i) k.push_back(pfxGetKey(p[i]));
    return k;
  };
  EXPECT_EQ(keys(result.outNewPairs, result.numOutNewPairs), (std::vector<PfxUInt32>{3, 4, 11}));
  EXPECT_EQ(keys(result.outKeepPairs, result.numOutKeepPairs), (std::vector<PfxUInt32>{2, 9}));
  EXPECT_EQ(keys(result.outRemovePairs, result.numOutRemovePairs), (std::vector<PfxUInt32>{1, 5}));
  EXPECT_EQ(pfxGetContactId(result.outKeepPairs[1]), 90u);
  for (const PfxBroadphasePair* p : {result.outNewPairs, result.outKeepPairs, result.outRemovePairs}) {
    EXPECT_GE(static_cast<const void*>(p), out.data);
    EXPECT_LE(static_cast<const void*>(p), static_cast<const void*>(out.end()));
  }
  param.pairBytes -= 1;
  EXPECT_EQ(pfxDecomposePairs(param, result), SCE_PFX_ERR_OUT_OF_BUFFER);
}

// The two tables of chapter 10, for every ordered pair of motion types.
TEST(CompatMotionTypes, TheTablesOfDetectionAndSolvingHold) {
  // Fixed, Active, Keyframe, OneWay, Trigger.
  const bool detects[5][5] = {{0, 1, 0, 1, 1}, {1, 1, 1, 1, 1}, {0, 1, 0, 1, 1}, {1, 1, 1, 0, 1}, {1, 1, 1, 1, 0}};
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 5; ++b) {
      Scene scene;
      scene.addBox(PfxVector3(0.5f), PfxVector3(0.0f), kTypes[a]);
      scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.9f, 0), kTypes[b]);
      scene.updatePairs();
      if (!detects[a][b]) {
        EXPECT_TRUE(scene.pairs.empty()) << a << " " << b;
        continue;
      }
      ASSERT_EQ(scene.pairs.size(), 1u) << a << " " << b;
      scene.collide();
      EXPECT_GT(scene.contacts[0].getNumContacts(), 0);
      scene.solve(0.016f, 10);
      const auto dynamic = [](int t) { return kTypes[t] == kPfxMotionTypeActive || kTypes[t] == kPfxMotionTypeOneWay; };
      const auto pushes = [](int t) { return kTypes[t] != kPfxMotionTypeOneWay && kTypes[t] != kPfxMotionTypeTrigger; };
      EXPECT_EQ(length(scene.states[0].getLinearVelocity()) > 0.01f, dynamic(a) && pushes(b)) << a << " " << b;
      EXPECT_EQ(length(scene.states[1].getLinearVelocity()) > 0.01f, dynamic(b) && pushes(a)) << a << " " << b;
    }
}

TEST(CompatContacts, SpheresTouchWhereTheyMust) {
  Scene scene;
  PfxShape sphere;
  sphere.setSphere(PfxSphere(1.0f));
  for (const PfxFloat x : {0.0f, 1.9f}) scene.add(sphere, PfxVector3(x, 0, 0), kPfxMotionTypeActive);
  scene.updatePairs();
  scene.collide();
  ASSERT_EQ(scene.contacts[0].getNumContacts(), 1);
  const PfxContactPoint& p = scene.contacts[0].getContactPoint(0);
  EXPECT_NEAR(p.m_distance, -0.1f, 1e-5f);
  EXPECT_NEAR(p.getNormal()[0], -1.0f, 1e-6f);  // from B to A
  EXPECT_NEAR(p.m_localPointA[0], 1.0f, 1e-5f);
  EXPECT_NEAR(p.m_localPointB[0], -1.0f, 1e-5f);
  scene.states[1].setPosition(PfxVector3(2.5f, 0, 0));
  PfxRefreshContactsParam refresh;
  refresh.contactPairs = scene.pairs.data(), refresh.numContactPairs = 1;
  refresh.offsetContactManifolds = scene.contacts.data(), refresh.offsetRigidStates = scene.states.data();
  refresh.numRigidBody = 2;
  ASSERT_EQ(pfxRefreshContacts(refresh), SCE_PFX_OK);
  EXPECT_EQ(scene.contacts[0].getNumContacts(), 0);
}

TEST(CompatSolver, SeparateBiasIsTheSpeedOfPushingApart) {
  std::vector<PfxFloat> depth;
  for (const PfxFloat bias : {0.1f, 0.2f, 0.5f}) {
    Scene scene;
    scene.separate_bias = bias;
    scene.addBox(PfxVector3(5, 1, 5), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
    scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.4f, 0), kPfxMotionTypeActive);
    for (int i = 0; i < 5; ++i) scene.step();
    depth.push_back(0.5f - scene.states[1].getPosition()[1]);
  }
  EXPECT_GT(depth[0], depth[1]);
  EXPECT_GT(depth[1], depth[2]);
}

TEST(CompatSolver, ChangesVelocitiesOnlyAndTheLastStageMoves) {
  Scene scene;
  scene.addBox(PfxVector3(5, 1, 5), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.49f, 0), kPfxMotionTypeActive);
  scene.states[1].setLinearVelocity(PfxVector3(0, -3, 0));
  scene.updatePairs();
  scene.collide();
  scene.solve(0.016f, 10);
  EXPECT_FLOAT_EQ(scene.states[1].getPosition()[1], 0.49f);
  EXPECT_GT(scene.states[1].getLinearVelocity()[1], 0.0f);
  PfxUpdateRigidStatesParam update;
  update.states = scene.states.data(), update.bodies = scene.bodies.data(), update.numRigidBody = 2, update.timeStep = 0.016f;
  const PfxVector3 v = scene.states[1].getLinearVelocity();
  ASSERT_EQ(pfxUpdateRigidStates(update), SCE_PFX_OK);
  EXPECT_FLOAT_EQ(scene.states[1].getPosition()[1], 0.49f + v[1] * 0.016f);
  EXPECT_FLOAT_EQ(scene.states[0].getPosition()[1], -1.0f);
  update.timeStep = 0.0f;
  EXPECT_EQ(pfxUpdateRigidStates(update), SCE_PFX_ERR_INVALID_VALUE);
}

TEST(CompatSolver, TwoFixedBodiesOnAJointStayWhereTheyAre) {
  Scene scene;
  for (const PfxFloat x : {0.0f, 3.0f}) scene.addBox(PfxVector3(0.5f), PfxVector3(x, 0, 0), kPfxMotionTypeFixed);
  scene.joints.emplace_back();
  PfxBallJointInitParam param;
  ASSERT_EQ(pfxInitializeBallJoint(scene.joints[0], scene.states[0], scene.states[1], param), SCE_PFX_OK);
  for (int i = 0; i < 10; ++i) scene.step();
  EXPECT_EQ(scene.states[1].getPosition()[0], 3.0f);
}

// A box of 1 kg drops on columns of boxes of 1 kg. As long as what takes back overlap stayed in the velocities these columns
// rocked for ever, and eight boxes fell over within 10 s; solved apart, it leaves them to come to rest.
TEST(CompatSolver, AColumnThatIsHitComesToRest) {
  for (const PfxUInt16 boxes : {2, 5, 8}) {
    for (const PfxFloat bias : {0.1f, 0.2f}) {
      Scene scene;
      scene.separate_bias = bias;
      scene.addBox(PfxVector3(5, 1, 5), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
      for (int i = 0; i < boxes; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f + static_cast<float>(i), 0), kPfxMotionTypeActive);
      scene.addBox(PfxVector3(0.2f), PfxVector3(0.1f, static_cast<float>(boxes) + 0.5f, 0.07f), kPfxMotionTypeActive);
      for (int i = 0; i < 540; ++i) scene.step(1.0f / 60.0f, 5);
      const PfxRigidState& top = scene.states[boxes];
      PfxFloat fastest = 0.0f;
      for (int i = 0; i < 60; ++i) scene.step(1.0f / 60.0f, 5), fastest = SCE_PFX_MAX(fastest, length(top.getLinearVelocity()));
      const PfxFloat off = std::hypot(top.getPosition()[0], top.getPosition()[2]);
      std::printf("%d boxes, bias %.1f: in the tenth second up to %.4f m/s, %.1f mm off\n", boxes, double(bias), double(fastest), 1e3 * double(off));
      EXPECT_LT(fastest, boxes == 8 ? 0.08f : 0.01f);
      EXPECT_LT(off, 0.02f);
      EXPECT_NEAR(top.getPosition()[1], boxes - 0.5f, 0.002f * boxes);
    }
  }
}

// 60 boxes fall on a floor and each other, some of them on joints: the same bits with and without workers.
TEST(CompatPipeline, WorkersDoNotChangeABit) {
  alignas(16) char work[1024];
  PfxPsp2TaskManager tasks(3, 3, work, sizeof work);
  ASSERT_EQ(tasks.initialize(), SCE_PFX_OK);
  Scene scenes[2];
  scenes[1].tasks = &tasks;
  for (Scene& scene : scenes) {
    scene.addBox(PfxVector3(20, 1, 20), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
    for (int i = 0; i < 150; ++i)
      scene.addBox(PfxVector3(0.4f), PfxVector3(1.0f * (i % 10) - 5.0f + 0.01f * i, 0.5f + 0.7f * (i / 50), 1.1f * (i / 10 % 5)),
                   kPfxMotionTypeActive);
    for (PfxUInt16 i = 10; i < 40; i = static_cast<PfxUInt16>(i + 10)) {
      scene.joints.emplace_back();
      PfxBallJointInitParam param;
      param.anchorPoint = scene.states[i].getPosition();
      ASSERT_EQ(pfxInitializeBallJoint(scene.joints.back(), scene.states[i], scene.states[i + 1u], param), SCE_PFX_OK);
    }
    for (int i = 0; i < 60; ++i) scene.step();
  }
  ASSERT_GT(scenes[0].pairs.size(), 100u);
  for (size_t i = 0; i < scenes[0].states.size(); ++i)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(scenes[0].states[i].getPosition()[k], scenes[1].states[i].getPosition()[k]) << i;
}

TEST(CompatErrors, EveryStageRefusesWhatIsMissing) {
  PfxConstraintPair pair = {};
  PfxDetectCollisionParam detect;
  detect.numContactPairs = 1;
  EXPECT_EQ(pfxDetectCollision(detect), SCE_PFX_ERR_INVALID_VALUE);
  PfxRefreshContactsParam refresh;
  refresh.numContactPairs = 1;
  EXPECT_EQ(pfxRefreshContacts(refresh), SCE_PFX_ERR_INVALID_VALUE);
  PfxSetupSolverBodiesParam bodies;
  bodies.numRigidBodies = 1;
  EXPECT_EQ(pfxSetupSolverBodies(bodies), SCE_PFX_ERR_INVALID_VALUE);
  PfxSetupContactConstraintsParam contacts;
  contacts.numContactPairs = 1, contacts.contactPairs = &pair;
  EXPECT_EQ(pfxSetupContactConstraints(contacts), SCE_PFX_ERR_INVALID_VALUE);
  PfxSetupJointConstraintsParam joints;
  joints.numJointPairs = 1, joints.jointPairs = &pair;
  EXPECT_EQ(pfxSetupJointConstraints(joints), SCE_PFX_ERR_INVALID_VALUE);
  PfxUpdateRigidStatesParam update;
  update.numRigidBodies = 1;
  EXPECT_EQ(pfxUpdateRigidStates(update), SCE_PFX_ERR_INVALID_VALUE);
  PfxDecomposePairsParam decompose;
  PfxDecomposePairsResult result;
  EXPECT_EQ(pfxDecomposePairs(decompose, result), SCE_PFX_ERR_INVALID_VALUE);
  PfxGenerateIslandParam island;
  PfxGenerateIslandResult islands;
  EXPECT_EQ(pfxGenerateIsland(island, islands), SCE_PFX_ERR_INVALID_VALUE);
}

}  // namespace
