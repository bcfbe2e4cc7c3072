// Rows of the feature list that no other test of the layer names, each with what it asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/compat/scene.h"

using namespace compat_tests;

namespace {

TEST(CompatRows, C2_02AWorldThatIsTooLargeFindsPairsThatAreNone) {
  size_t pairs[2];
  for (int k = 0; k < 2; ++k) {
    Scene scene;
    for (int i = 0; i < 100; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(1.01f * static_cast<float>(i), 0, 0), kPfxMotionTypeActive);
    const PfxUInt32 n = 100;
    std::vector<PfxBroadphaseProxy> proxies(n), work(n);
    for (PfxUInt32 i = 0; i < n; ++i)
      pfxUpdateBroadphaseProxy(proxies[i], scene.states[i], scene.collidables[i], PfxVector3(0.0f), PfxVector3(k == 0 ? 500.0f : 50000.0f), 0);
    ASSERT_EQ(pfxParallelSort(proxies.data(), n, work.data(), n * sizeof(PfxBroadphaseProxy)), SCE_PFX_OK);
    PfxFindPairsParam param;
    param.maxPairs = 1000;
    Buffer find(pfxGetWorkBytesOfFindPairs(1000)), out(pfxGetPairBytesOfFindPairs(1000));
    param.workBuff = find.data, param.workBytes = find.bytes, param.pairBuff = out.data, param.pairBytes = out.bytes;
    param.proxies = proxies.data(), param.numProxies = n;
    PfxFindPairsResult result;
    ASSERT_EQ(pfxFindPairs(param, result), SCE_PFX_OK);
    pairs[k] = result.numPairs;
  }
  std::printf("boxes 1 cm apart: %zu false pairs in a world of 500 m, %zu in one of 50 km\n", pairs[0], pairs[1]);
  EXPECT_EQ(pairs[0], 0u);
  EXPECT_GT(pairs[1], 50u);
}

TEST(CompatRows, C2_22AMotionTypeTakesEffectInTheNextStep) {
  Scene scene;
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 10, 0), kPfxMotionTypeActive);
  PfxRigidState& s = scene.states[0];
  for (int i = 0; i < 5; ++i) scene.step();
  s.setMotionType(kPfxMotionTypeFixed);
  const PfxVector3 held = s.getPosition();
  for (int i = 0; i < 5; ++i) scene.step();
  EXPECT_EQ(length(s.getPosition() - held), 0.0f);
  s.setMotionType(kPfxMotionTypeActive);
  scene.step();
  EXPECT_LT(s.getPosition()[1], held[1]);
}

TEST(CompatRows, C2_30TheLowLevelPutsNothingToSleep) {
  Scene scene;
  scene.addBox(PfxVector3(5, 1, 5), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 1000; ++i) scene.step();
  EXPECT_TRUE(scene.states[1].isAwake());
}

TEST(CompatRows, C3_46MotionMasksStandForTypesAndSleep) {
  PfxRigidState state;
  for (int type = 0; type < kPfxMotionTypeCount; ++type) {
    state.wakeup();
    state.setMotionType(static_cast<ePfxMotionType>(type));
    EXPECT_EQ(state.getMotionMask(), 1 << type);
    const bool dynamic = type == kPfxMotionTypeActive || type == kPfxMotionTypeOneWay;
    EXPECT_EQ((state.getMotionMask() & SCE_PFX_MOTION_MASK_DYNAMIC) != 0, dynamic);
    EXPECT_EQ((state.getMotionMask() & SCE_PFX_MOTION_MASK_STATIC) != 0, !dynamic);
    EXPECT_EQ(SCE_PFX_MOTION_MASK_CAN_SLEEP(type), state.canSleep());
    state.sleep();
    EXPECT_EQ((state.getMotionMask() & SCE_PFX_MOTION_MASK_SLEEPING) != 0, state.canSleep());
  }
}

// A locked axis stands where the joint was made, whatever range it had.
TEST(CompatRows, C2_10AnAxisIsLockedAndFreedAtRunTime) {
  Scene scene;
  scene.gravity = PfxVector3(0.0f);
  scene.addBox(PfxVector3(0.2f), PfxVector3(0.0f), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.2f), PfxVector3(1, 0, 0), kPfxMotionTypeActive);
  scene.joints.emplace_back();
  PfxHingeJointInitParam param;
  param.axis = PfxVector3(0, 0, 1), param.lowerAngle = -0.5f, param.upperAngle = 0.7f;
  ASSERT_EQ(pfxInitializeHingeJoint(scene.joints[0], scene.states[0], scene.states[1], param), SCE_PFX_OK);
  scene.joints[0].m_constraints[3].m_lock = SCE_PFX_JOINT_LOCK_FIX;
  scene.states[1].setLinearVelocity(PfxVector3(0, 1, 0));
  for (int i = 0; i < 30; ++i) scene.step(0.016f, 5);
  EXPECT_NEAR(scene.states[1].getPosition()[1], 0.0f, 1e-4f);
  scene.joints[0].m_constraints[3].m_lock = SCE_PFX_JOINT_LOCK_FREE;
  scene.states[1].setLinearVelocity(PfxVector3(0, 1, 0));
  scene.states[1].setAngularVelocity(PfxVector3(0, 0, 1));
  for (int i = 0; i < 60; ++i) scene.step(0.016f, 5);
  EXPECT_GT(std::atan2(scene.states[1].getPosition()[1], scene.states[1].getPosition()[0]), 0.75f);
}

// Without weight nothing holds, also when the impulses of the step before are taken over.
TEST(CompatRows, C10_14WeightIsTakenAwayWhileTheJointCarries) {
  Scene scene;
  scene.addBox(PfxVector3(0.2f), PfxVector3(0.0f), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.2f), PfxVector3(0, -1, 0), kPfxMotionTypeActive);
  scene.joints.emplace_back();
  ASSERT_EQ(pfxInitializeBallJoint(scene.joints[0], scene.states[0], scene.states[1], PfxBallJointInitParam()), SCE_PFX_OK);
  for (int i = 0; i < 30; ++i) scene.step(0.016f, 5);
  EXPECT_NEAR(scene.states[1].getPosition()[1], -1.0f, 1e-3f);
  for (PfxJointConstraint& c : scene.joints[0].m_constraints) c.m_weight = 0.0f;
  const PfxFloat before = scene.states[1].getLinearVelocity()[1];
  scene.step(0.016f, 5);
  EXPECT_NEAR(scene.states[1].getLinearVelocity()[1] - before, -9.8f * 0.016f, 1e-4f);
}

// Damping takes its share of the motion, not of the force: what hangs on a damped hinge still falls.
TEST(CompatRows, C10_09ADampedHingeFallsToItsTerminalVelocity) {
  PfxFloat angle[3], rate[3];
  for (int k = 0; k < 3; ++k) {
    Scene scene;
    scene.addBox(PfxVector3(0.2f), PfxVector3(0.0f), kPfxMotionTypeFixed);
    scene.addBox(PfxVector3(0.2f), PfxVector3(2, 0, 0), kPfxMotionTypeActive);
    scene.states[1].setAngularDamping(1.0f);
    scene.joints.emplace_back();
    PfxHingeJointInitParam param;
    param.axis = PfxVector3(0, 0, 1), param.damping = k == 0 ? 0.0f : k == 1 ? 0.1f : 0.5f;
    ASSERT_EQ(pfxInitializeHingeJoint(scene.joints[0], scene.states[0], scene.states[1], param), SCE_PFX_OK);
    for (int i = 0; i < 10; ++i) scene.step(0.01f, 5);
    angle[k] = -std::atan2(scene.states[1].getPosition()[1], scene.states[1].getPosition()[0]);
    rate[k] = -scene.states[1].getAngularVelocity()[2];
  }
  // d w / dt = g r / (r^2 + I / m) at a nearly level arm; damped by a share d in each step, w tends to (1 - d) / d of a step's gain.
  const PfxFloat gain = 9.8f * 2.0f / (4.0f + 0.08f / 3.0f) * 0.01f;
  EXPECT_NEAR(rate[0], 10.0f * gain, 0.02f * 10.0f * gain);
  EXPECT_NEAR(rate[1], gain * 0.9f / 0.1f * (1.0f - std::pow(0.9f, 10.0f)), 0.02f * gain * 9.0f);
  EXPECT_NEAR(rate[2], gain, 0.02f * gain);
  EXPECT_GT(angle[0], angle[1]);
  EXPECT_GT(angle[1], angle[2]);
}

TEST(CompatRows, C8_28EverythingOfAThousandBodiesIsDrawnInTwoMilliseconds) {
  Scene scene;
  for (int i = 0; i < 1000; ++i)
    scene.addBox(PfxVector3(0.5f), PfxVector3(0.95f * static_cast<float>(i % 10), 0.95f * static_cast<float>(i / 100), 0.95f * static_cast<float>(i / 10 % 10)),
                 kPfxMotionTypeActive);
  static int calls = 0;
  PfxDebugRender render;
  render.setDebugRenderPointFunc([](const PfxVector3&, const PfxVector3&) { ++calls; });
  render.setDebugRenderLineFunc([](const PfxVector3&, const PfxVector3&, const PfxVector3&) { ++calls; });
  render.setDebugRenderAabbFunc([](const PfxVector3&, const PfxVector3&, const PfxVector3&) { ++calls; });
  render.resetVisible(1000);
  double best = 1e9;
  for (int trial = 0; trial < 10; ++trial) {
    const auto start = std::chrono::steady_clock::now();
    render.renderWorld(PfxVector3(0.0f), PfxVector3(500.0f));
    render.renderAabb(scene.states.data(), scene.collidables.data(), 1000u);
    render.renderLocalAxis(scene.states.data(), 1000u);
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_EQ(calls, 10 * (1 + 1000 + 3000));
  std::printf("drawn in %.3f ms\n", best);
  EXPECT_LT(best, 2.0);
}

}  // namespace
