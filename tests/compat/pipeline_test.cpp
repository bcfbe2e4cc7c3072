// Chapters 3 and 4: the pipeline of the overview, written as its users write it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/compat/scene.h"

using namespace compat_tests;

namespace {

TEST(CompatPipeline, ABoxFallsAndRestsOnTheGround) {
  Scene scene;
  scene.addBox(PfxVector3(10, 1, 10), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 3, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 300; ++i) scene.step();
  EXPECT_NEAR(scene.states[1].getPosition()[1], 0.5f, 0.005f);  // less than 3 mm of overlap is taken back slowly
  EXPECT_LT(length(scene.states[1].getLinearVelocity()), 0.01f);
  EXPECT_EQ(scene.states[0].getPosition()[1], -1.0f);
  EXPECT_TRUE(scene.states[1].isAwake());
}

TEST(CompatPipeline, AColumnOfFiveBoxesStands) {
  Scene scene;
  scene.addBox(PfxVector3(10, 1, 10), PfxVector3(0, -1, 0), kPfxMotionTypeFixed);
  for (int i = 0; i < 5; ++i) scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f + i, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 600; ++i) scene.step(0.016f, 5);
  for (int i = 0; i < 5; ++i) {
    // Each face may sink in by the 3 mm that the solver takes back slowly; sideways nothing moves the boxes but what five
    // iterations leave of the impulses of the first steps.
    const PfxVector3 away = scene.states[1 + i].getPosition() - PfxVector3(0, 0.5f + i, 0);
    EXPECT_LT(maxElem(absPerElem(away)), 0.005f) << i;
    EXPECT_LT(length(scene.states[1 + i].getLinearVelocity()), 0.001f) << i;
  }
}

// Which face is the reference changes while a column settles; the names of the features change with it, the points do not.
TEST(CompatPipeline, ContactPointsKeepTheirImpulsesWhenTheReferenceFaceChanges) {
  Scene scene;
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0, 0), kPfxMotionTypeActive);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 0.999f, 0), kPfxMotionTypeActive);
  for (int i = 0; i < 50; ++i) {  // rocks to and fro by a ten-thousandth of a radian
    scene.states[0].setOrientation(PfxQuat::rotationZ(1e-4f * (i % 3 - 1)));
    scene.states[1].setOrientation(PfxQuat::rotationX(1e-4f * (i % 5 - 2)));
    scene.updatePairs();
    scene.collide();
    for (int k = 0; k < scene.contacts[0].getNumContacts(); ++k)
      EXPECT_EQ(scene.contacts[0].getContactPoint(k).m_duration, i) << k;
  }
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
