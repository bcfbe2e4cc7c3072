// Chapters 2 and 3: states, bodies, shapes and collidables.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compat/physics_effects.h"

using namespace sce::PhysicsEffects;

namespace {

TEST(CompatBodies, AStateStartsActiveAtRestWithAllFiltersOpen) {
  PfxRigidState state;
  state.setPosition(PfxVector3(1, 2, 3));
  state.setMotionType(kPfxMotionTypeTrigger);
  state.reset();
  EXPECT_EQ(state.getMotionType(), kPfxMotionTypeActive);
  EXPECT_EQ(state.getContactFilterSelf(), 0xffffffffu);
  EXPECT_EQ(state.getContactFilterTarget(), 0xffffffffu);
  EXPECT_EQ(length(state.getPosition()), 0.0f);
  EXPECT_EQ(length(state.getLinearVelocity()) + length(state.getAngularVelocity()), 0.0f);
  EXPECT_TRUE(state.isAwake());
}

TEST(CompatBodies, WhatIsSetIsWhatIsGot) {
  PfxRigidState state;
  state.setPosition(PfxVector3(1, 2, 3));
  state.setOrientation(PfxQuat(0, 1, 0, 0));
  state.setLinearVelocity(PfxVector3(4, 5, 6));
  state.setAngularVelocity(PfxVector3(7, 8, 9));
  state.setRigidBodyId(77);
  state.setContactFilterSelf(5);
  state.setContactFilterTarget(6);
  EXPECT_EQ(state.getPosition()[2], 3.0f);
  EXPECT_EQ(state.getOrientation()[1], 1.0f);
  EXPECT_EQ(state.getLinearVelocity()[0], 4.0f);
  EXPECT_EQ(state.getAngularVelocity()[1], 8.0f);
  EXPECT_EQ(state.getRigidBodyId(), 77);
  EXPECT_EQ(state.getContactFilterSelf(), 5u);
  EXPECT_EQ(state.getContactFilterTarget(), 6u);
  PfxRigidBody body;
  body.reset();
  EXPECT_FLOAT_EQ(body.getRestitution(), 0.2f);
  EXPECT_FLOAT_EQ(body.getFriction(), 0.6f);
  body.setMass(4.0f);
  body.setInertia(pfxCalcInertiaSphere(0.5f, 4.0f));
  EXPECT_FLOAT_EQ(body.getMassInv(), 0.25f);
  EXPECT_FLOAT_EQ(body.getInertia()[0][0], 0.4f);
  EXPECT_FLOAT_EQ(body.getInertiaInv()[1][1], 2.5f);
}

TEST(CompatBodies, InertiaAndMassAreThoseOfSolids) {
  const PfxFloat pi = SCE_PFX_PI;
  EXPECT_FLOAT_EQ(pfxCalcInertiaSphere(2.0f, 3.0f)[1][1], 0.4f * 3.0f * 4.0f);
  EXPECT_FLOAT_EQ(pfxCalcInertiaBox(PfxVector3(1, 2, 3), 6.0f)[0][0], 6.0f / 3.0f * (4.0f + 9.0f));
  EXPECT_FLOAT_EQ(pfxCalcInertiaCylinderX(2.0f, 1.0f, 3.0f)[0][0], 1.5f);
  EXPECT_FLOAT_EQ(pfxCalcInertiaCylinderY(2.0f, 1.0f, 3.0f)[1][1], 1.5f);
  EXPECT_FLOAT_EQ(pfxCalcInertiaCylinderZ(2.0f, 1.0f, 3.0f)[0][0], 3.0f * (0.25f + 4.0f / 3.0f));
  EXPECT_FLOAT_EQ(pfxCalcMassSphere(2.0f, 1.0f), 2.0f * 4.0f / 3.0f * pi);
  EXPECT_FLOAT_EQ(pfxCalcMassBox(2.0f, PfxVector3(1, 2, 3)), 96.0f);
  EXPECT_FLOAT_EQ(pfxCalcMassCylinder(2.0f, 2.0f, 1.0f), 8.0f * pi);
}

TEST(CompatBodies, ShapesAreCopiedWhenTheyAreAddedAndBoundsComeWithFinish) {
  PfxShape shape;
  shape.reset();
  PfxSphere sphere(2.0f);
  shape.setSphere(sphere);
  PfxCollidable collidable;
  collidable.reset();
  collidable.addShape(shape);
  EXPECT_EQ(length(collidable.getHalf()), 0.0f);
  sphere.m_radius = 9.0f;
  shape.setBox(PfxBox(9, 9, 9));
  collidable.finish();
  EXPECT_EQ(collidable.getNumShapes(), 1u);
  EXPECT_EQ(collidable.getShape(0).getType(), kPfxShapeSphere);
  EXPECT_FLOAT_EQ(collidable.getHalf()[0], 2.0f);
  EXPECT_NE(collidable.addShape(shape), SCE_PFX_OK);  // there is room for one
}

TEST(CompatBodies, OffsetsMoveAndTurnAShapeInItsBody) {
  PfxShape shapes[2], shape;
  PfxUInt16 ids[2] = {0, 1};
  PfxCollidable collidable;
  collidable.reset(shapes, ids, 2);
  shape.reset();
  shape.setCapsule(PfxCapsule(1.5f, 0.5f));  // along x ...
  shape.setOffsetOrientation(PfxQuat::rotationZ(0.5f * SCE_PFX_PI));  // ... and now along y
  collidable.addShape(shape);
  shape.reset();
  shape.setBox(PfxBox(PfxVector3(0.5f)));
  shape.setOffsetPosition(PfxVector3(3, 0, 0));
  collidable.addShape(shape);
  collidable.finish();
  const PfxVector3 lower = collidable.getCenter() - collidable.getHalf(), upper = collidable.getCenter() + collidable.getHalf();
  EXPECT_NEAR(lower[0], -0.5f, 1e-5f);
  EXPECT_NEAR(upper[0], 3.5f, 1e-5f);
  EXPECT_NEAR(lower[1], -2.0f, 1e-5f);
  EXPECT_NEAR(upper[1], 2.0f, 1e-5f);
}

TEST(CompatBodies, SixtyFourShapesAreTheMost) {
  PfxShape shapes[65], shape;
  PfxUInt16 ids[65];
  for (PfxUInt16 i = 0; i < 65; ++i) ids[i] = i;
  shape.setSphere(PfxSphere(0.1f));
  PfxCollidable collidable;
  ASSERT_EQ(collidable.reset(shapes, ids, 64), SCE_PFX_OK);
  for (int i = 0; i < 64; ++i) {
    shape.setOffsetPosition(PfxVector3(static_cast<PfxFloat>(i), 0, 0));
    EXPECT_EQ(collidable.addShape(shape), SCE_PFX_OK);
  }
  EXPECT_EQ(collidable.addShape(shape), SCE_PFX_ERR_OUT_OF_RANGE);
  EXPECT_EQ(collidable.finish(), SCE_PFX_OK);
  EXPECT_NEAR(collidable.getHalf()[0], 31.6f, 1e-4f);
  EXPECT_EQ(collidable.reset(shapes, ids, 65), SCE_PFX_ERR_OUT_OF_RANGE);
  EXPECT_EQ(collidable.reset(nullptr, ids, 2), SCE_PFX_ERR_INVALID_VALUE);
}

TEST(CompatBodies, ASizeThatIsNoSizeIsAnError) {
  for (const PfxFloat radius : {0.0f, -1.0f, std::numeric_limits<PfxFloat>::quiet_NaN(), std::numeric_limits<PfxFloat>::infinity()}) {
    PfxShape shape;
    shape.setSphere(PfxSphere(radius));
    PfxCollidable collidable;
    collidable.addShape(shape);
    EXPECT_EQ(collidable.finish(), SCE_PFX_ERR_INVALID_VALUE) << radius;
  }
}

TEST(CompatBodies, OnlyBodiesThatMayCanSleep) {
  const ePfxMotionType types[] = {kPfxMotionTypeFixed, kPfxMotionTypeActive, kPfxMotionTypeKeyframe, kPfxMotionTypeOneWay,
                                  kPfxMotionTypeTrigger};
  const bool sleeps[] = {false, true, true, true, false};
  for (int i = 0; i < 5; ++i) {
    PfxRigidState state;
    state.setMotionType(types[i]);
    state.setUseSleep(1);
    state.sleep();
    EXPECT_EQ(state.isAsleep(), sleeps[i]) << i;
    state.wakeup();
    EXPECT_TRUE(state.isAwake());
    state.setUseSleep(0);
    state.sleep();
    EXPECT_TRUE(state.isAwake());
  }
}

TEST(CompatBodies, AKeyframeBodyIsSentToAPose) {
  PfxRigidState state;
  PfxRigidBody body;
  state.setMotionType(kPfxMotionTypeKeyframe);
  const PfxFloat step = 1.0f / 60.0f;
  for (int i = 1; i <= 600; ++i) {
    state.movePosition(PfxVector3(0.01f * i, 0, 0), step);
    state.moveOrientation(PfxQuat::rotationY(0.02f * i), step);
    EXPECT_NEAR(state.getAngularVelocity()[1], 1.2f, 1e-3f);
    PfxUpdateRigidStatesParam param;
    param.states = &state, param.bodies = &body, param.numRigidBodies = 1, param.timeStep = step;
    ASSERT_EQ(pfxUpdateRigidStates(param), SCE_PFX_OK);
    EXPECT_NEAR(state.getPosition()[0], 0.01f * i, 1e-5f);
    const PfxQuat expected = PfxQuat::rotationY(0.02f * i);
    EXPECT_NEAR(std::abs(dot(state.getOrientation(), expected)), 1.0f, 1e-5f) << i;
  }
  state.setMotionType(kPfxMotionTypeFixed);
  state.setLinearVelocity(PfxVector3(0.0f));
  state.movePosition(PfxVector3(9.0f), step);
  EXPECT_EQ(length(state.getLinearVelocity()), 0.0f);
}

}  // namespace
