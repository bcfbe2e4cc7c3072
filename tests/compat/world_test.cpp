// The high level: HL-01 .. HL-14 of the feature list, a test for each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "compat/physics_effects.h"

using namespace sce::PhysicsEffects;

namespace {

// A world in a pool of exactly the bytes that it asks for, with a guard behind.
struct Owned {
  static constexpr PfxUInt32 kGuard = 64;
  PfxRigidBodyWorldParam param;
  void* pool;
  PfxRigidBodyWorld world;

  static PfxRigidBodyWorldParam withPool(PfxRigidBodyWorldParam p) {
    p.poolBytes = PfxRigidBodyWorld::getRigidBodyWorldBytes(p);
    p.poolBuff = std::aligned_alloc(16, SCE_PFX_BYTES_ALIGN16(p.poolBytes + kGuard));
    std::fill_n(static_cast<unsigned char*>(p.poolBuff) + p.poolBytes, kGuard, static_cast<unsigned char>(0x5a));
    return p;
  }
  explicit Owned(const PfxRigidBodyWorldParam& p = PfxRigidBodyWorldParam()) : param(withPool(p)), pool(param.poolBuff), world(param) {
    EXPECT_EQ(world.initialize(), SCE_PFX_OK);
  }
  ~Owned() {
    for (PfxUInt32 i = 0; i < kGuard; ++i) EXPECT_EQ(static_cast<unsigned char*>(pool)[param.poolBytes + i], 0x5a) << "behind the pool";
    std::free(pool);
  }

  PfxUInt32 addBox(const PfxVector3& half, const PfxVector3& position, ePfxMotionType type = kPfxMotionTypeActive, PfxFloat mass = 1.0f) {
    PfxShape shape;
    shape.setBox(PfxBox(half));
    PfxCollidable collidable;
    collidable.addShape(shape);
    collidable.finish();
    PfxRigidBody body;
    body.setMass(mass);
    body.setInertia(pfxCalcInertiaBox(half, mass));
    PfxRigidState state;
    state.setPosition(position);
    state.setMotionType(type);
    return world.addRigidBody(state, body, collidable);
  }
  void addGround() { addBox(PfxVector3(50, 2.5f, 50), PfxVector3(0, -2.5f, 0), kPfxMotionTypeFixed); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_EQ(world.simulate(), SCE_PFX_OK);
  }
  PfxVector3 at(PfxUInt32 id) { return world.getRigidState(id).getPosition(); }
};

TEST(CompatWorld, HL01ParametersHaveTheirDefaults) {
  const PfxRigidBodyWorldParam p;
  EXPECT_EQ(p.maxRigidBodies, 500u);
  EXPECT_EQ(p.maxJoints, 500u);
  EXPECT_EQ(p.maxShapes, 100u);
  EXPECT_EQ(p.maxContacts, 4000u);
  EXPECT_EQ(p.maxNonContactPairs, 100u);
  EXPECT_EQ(p.worldExtent[1], 500.0f);
  EXPECT_EQ(p.gravity[1], -9.8f);
  EXPECT_EQ(p.timeStep, 1.0f / 60.0f);
  EXPECT_EQ(p.separateBias, 0.2f);
  EXPECT_EQ(p.iteration, 5u);
  EXPECT_EQ(p.sleepCount, 180u);
  EXPECT_EQ(p.sleepVelocity, 0.1f);
  Owned w;
  w.addBox(PfxVector3(1.0f), PfxVector3(0, 10, 0));
  w.run(60);
  EXPECT_NEAR(w.at(0)[1], 10.0f - 4.9f, 0.1f);
}

TEST(CompatWorld, HL02TheExactSizeWorksAndOneByteLessIsRefused) {
  Owned w;
  PfxRigidBodyWorldParam less = w.param;
  --less.poolBytes;
  PfxRigidBodyWorld world(less);
  EXPECT_EQ(world.initialize(), SCE_PFX_ERR_OUT_OF_BUFFER);
  EXPECT_EQ(world.simulate(), SCE_PFX_ERR_INVALID_VALUE);
  less.poolBuff = static_cast<char*>(less.poolBuff) + 4;
  EXPECT_EQ(PfxRigidBodyWorld(less).initialize(), SCE_PFX_ERR_INVALID_ALIGN);
  less.poolBuff = nullptr;
  EXPECT_EQ(PfxRigidBodyWorld(less).initialize(), SCE_PFX_ERR_INVALID_VALUE);
}

TEST(CompatWorld, HL03ItIsResetAHundredTimes) {
  Owned w;
  for (int i = 0; i < 100; ++i) {
    w.addGround();
    w.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f, 0));
    PfxCollidable compound;
    ASSERT_EQ(w.world.setupCollidable(compound, 60), SCE_PFX_OK);
    w.run(3);
    ASSERT_EQ(w.world.getContactCount(), 1u);
    ASSERT_EQ(w.world.reset(), SCE_PFX_OK);
    ASSERT_EQ(w.world.getRigidBodyCount(), 0u);
    ASSERT_EQ(w.world.getContactCount(), 0u);
  }
  EXPECT_EQ(w.world.finalize(), SCE_PFX_OK);
  EXPECT_EQ(w.world.reset(), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(w.world.initialize(), SCE_PFX_OK);
}

TEST(CompatWorld, HL04ATowerStands) {
  Owned w;
  w.addGround();
  const PfxFloat radius = 1.3f * 24.0f / SCE_PFX_PI;
  std::vector<PfxUInt32> ids;
  for (int layer = 0; layer < 8; ++layer)
    for (int i = 0; i < 24; ++i) {
      const PfxQuat turn = PfxQuat::rotationY(2.0f * SCE_PFX_PI * (i + 0.5f * (layer % 2)) / 24.0f);
      ids.push_back(w.addBox(PfxVector3(1.0f), rotate(turn, PfxVector3(0, 1.0f + 2.0f * layer, radius)), kPfxMotionTypeActive, 0.5f));
      w.world.getRigidState(ids.back()).setOrientation(turn);
    }
  std::vector<PfxVector3> start;
  for (const PfxUInt32 id : ids) start.push_back(w.at(id));
  w.run(600);
  PfxFloat most = 0.0f;
  for (size_t i = 0; i < ids.size(); ++i) most = std::max<PfxFloat>(most, length(w.at(ids[i]) - start[i]));
  std::printf("drift of the tower of 192 boxes after 600 steps: %.1f mm\n", 1e3 * double(most));
  EXPECT_LT(most, 0.1f);
}

TEST(CompatWorld, HL05BodiesComeAndGoTenThousandTimes) {
  PfxRigidBodyWorldParam param;
  param.maxRigidBodies = 50;
  Owned w(param);
  w.addGround();
  std::mt19937 random(3);
  std::vector<PfxUInt32> alive;
  for (int i = 0; i < 10000; ++i) {
    const bool add = alive.empty() || (alive.size() < 49 && random() % 2 == 0);
    if (add) {
      alive.push_back(w.addBox(PfxVector3(0.5f), PfxVector3(static_cast<float>(random() % 20), 0.5f, static_cast<float>(random() % 20))));
      ASSERT_LT(alive.back(), 50u);
      ASSERT_FALSE(w.world.isRemovedRigidBody(alive.back()));
    } else {
      const size_t k = random() % alive.size();
      ASSERT_EQ(w.world.removeRigidBody(alive[k]), SCE_PFX_OK);
      ASSERT_TRUE(w.world.isRemovedRigidBody(alive[k]));
      ASSERT_EQ(w.world.removeRigidBody(alive[k]), SCE_PFX_ERR_OUT_OF_RANGE);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (i % 100 == 0) w.run(1);
  }
  while (alive.size() < 49) alive.push_back(w.addBox(PfxVector3(0.5f), PfxVector3(0, 50, 0)));
  EXPECT_EQ(w.addBox(PfxVector3(0.5f), PfxVector3(0.0f)), PfxRigidBodyWorld::kInvalidId);
  std::sort(alive.begin(), alive.end());
  EXPECT_EQ(std::unique(alive.begin(), alive.end()), alive.end());  // no id twice
  // A removed body is inert: nothing meets it and it stays where it was put.
  ASSERT_EQ(w.world.removeRigidBody(alive[0]), SCE_PFX_OK);
  const PfxVector3 place = w.at(alive[0]);
  w.run(2);
  EXPECT_EQ(length(w.at(alive[0]) - place), 0.0f);
  for (PfxUInt32 i = 0; i < w.world.getContactCount(); ++i) {
    EXPECT_NE(pfxGetRigidBodyIdA(w.world.getContactPair(i)), alive[0]);
    EXPECT_NE(pfxGetRigidBodyIdB(w.world.getContactPair(i)), alive[0]);
  }
}

// Hangs a box on a ball joint at the height of its start, 2 m beside.
PfxUInt32 hang(Owned& w, PfxUInt32 fixed, PfxUInt32 box) {
  PfxBallJointInitParam param;
  param.anchorPoint = PfxVector3(0, 5, 0);
  PfxJoint joint;
  EXPECT_EQ(pfxInitializeBallJoint(joint, w.world.getRigidState(fixed), w.world.getRigidState(box), param), SCE_PFX_OK);
  return w.world.addJoint(joint);
}

TEST(CompatWorld, HL06AJointIsRemovedInMidSwing) {
  Owned w;
  const PfxUInt32 fixed = w.addBox(PfxVector3(0.2f), PfxVector3(0, 5, 0), kPfxMotionTypeFixed), box = w.addBox(PfxVector3(0.2f), PfxVector3(2, 5, 0));
  const PfxUInt32 joint = hang(w, fixed, box);
  w.run(30);
  EXPECT_NEAR(length(w.at(box) - PfxVector3(0, 5, 0)), 2.0f, 0.02f);
  EXPECT_LT(w.at(box)[1], 4.5f);
  PfxJoint other = w.world.getJoint(joint);
  for (PfxJointConstraint& c : other.m_constraints) c.m_weight = 0.0f;
  EXPECT_EQ(w.world.updateJoint(joint, other), SCE_PFX_OK);
  const PfxVector3 v = w.world.getRigidState(box).getLinearVelocity();
  w.run(1);
  EXPECT_NEAR(w.world.getRigidState(box).getLinearVelocity()[0], v[0], 1e-5f);  // on its own
  EXPECT_EQ(w.world.removeJoint(joint), SCE_PFX_OK);
  EXPECT_TRUE(w.world.isRemovedJoint(joint));
  EXPECT_EQ(w.world.removeJoint(joint), SCE_PFX_ERR_OUT_OF_RANGE);
  w.run(30);
  EXPECT_GT(length(w.at(box) - PfxVector3(0, 5, 0)), 2.2f);
  EXPECT_EQ(hang(w, fixed, box), joint);  // its place is free
  EXPECT_EQ(w.world.removeRigidBody(box), SCE_PFX_OK);
  EXPECT_TRUE(w.world.isRemovedJoint(joint));  // goes with its body
}

TEST(CompatWorld, HL07AccessorsAreBounded) {
  PfxRigidBodyWorldParam param;
  param.maxRigidBodies = 7, param.maxJoints = 6, param.maxShapes = 5, param.maxContacts = 4, param.maxNonContactPairs = 3;
  Owned w(param);
  EXPECT_EQ(w.world.getRigidBodyCapacity(), 7u);
  EXPECT_EQ(w.world.getJointCapacity(), 6u);
  EXPECT_EQ(w.world.getShapeCapacity(), 5u);
  EXPECT_EQ(w.world.getContactCapacity(), 4u);
  EXPECT_EQ(w.world.getNonContactPairCapacity(), 3u);
  w.addGround();
  const PfxUInt32 box = w.addBox(PfxVector3(0.5f), PfxVector3(0, 0.5f, 0), kPfxMotionTypeActive, 3.0f);
  w.run(1);
  EXPECT_EQ(w.world.getRigidBodyCount(), 2u);
  EXPECT_EQ(w.world.getJointCount(), 0u);
  EXPECT_EQ(w.world.getRigidBody(box).getMass(), 3.0f);
  EXPECT_EQ(w.world.getRigidBodyArray() + box, &w.world.getRigidBody(box));
  EXPECT_EQ(w.world.getRigidStateArray() + box, &w.world.getRigidState(box));
  EXPECT_EQ(w.world.getCollidable(box).getHalf()[0], 0.5f);
  ASSERT_EQ(w.world.getContactCount(), 1u);
  EXPECT_EQ(w.world.getContactManifold(0).getNumContacts(), 4);
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(w.world.getRigidState(2), "out of range");
  EXPECT_DEATH(w.world.getJoint(0), "out of range");
  EXPECT_DEATH(w.world.getContactManifold(1), "out of range");
}

TEST(CompatWorld, HL08SettersTakeEffectInTheNextStep) {
  Owned w;
  const PfxUInt32 box = w.addBox(PfxVector3(0.5f), PfxVector3(0.0f));
  w.world.setGravity(PfxVector3(0, 4, 0));
  w.world.setTimeStep(0.5f);
  w.run(1);
  EXPECT_NEAR(w.world.getRigidState(box).getLinearVelocity()[1], 2.0f, 1e-5f);
  w.world.setWorldCenter(PfxVector3(100, 0, 0));
  w.world.setWorldExtent(PfxVector3(10.0f));
  w.run(1);
  EXPECT_EQ(w.world.getRigidState(box).getMotionType(), kPfxMotionTypeFixed);  // has left the world
  w.world.setIteration(9), w.world.setSeparateBias(0.3f), w.world.setSleepCount(3), w.world.setSleepVelocity(0.2f);
  EXPECT_EQ(w.world.getIteration(), 9u);
  EXPECT_EQ(w.world.getSeparateBias(), 0.3f);
  EXPECT_EQ(w.world.getSleepCount(), 3u);
  EXPECT_EQ(w.world.getSleepVelocity(), 0.2f);
  EXPECT_EQ(w.world.getTimeStep(), 0.5f);
}

TEST(CompatWorld, HL09IslandsAtRestFallAsleepAndWakeWhenTouched) {
  PfxRigidBodyWorldParam param;
  param.simulationFlag = SCE_PFX_ENABLE_SLEEP;
  Owned w(param);
  w.addGround();
  for (int i = 0; i < 6; ++i)  // two small pyramids
    w.addBox(PfxVector3(0.5f), PfxVector3((i < 3 ? 0.0f : 10.0f) + 0.55f * static_cast<float>(i % 3 - 1) * (i % 3 == 1 ? 0.0f : 1.0f), i % 3 == 1 ? 1.5f : 0.5f, 0));
  w.run(400);
  for (PfxUInt32 i = 1; i <= 6; ++i) EXPECT_TRUE(w.world.getRigidState(i).isAsleep()) << i;
  const PfxUInt32 stone = w.addBox(PfxVector3(0.2f), PfxVector3(0, 2.5f, 0));
  w.run(30);
  for (PfxUInt32 i = 1; i <= 6; ++i) EXPECT_EQ(w.world.getRigidState(i).isAsleep(), i > 3) << i;
  w.run(400);
  for (PfxUInt32 i = 1; i <= stone; ++i) EXPECT_TRUE(w.world.getRigidState(i).isAsleep()) << i;
  w.world.removeRigidBody(1);  // from under the top
  w.run(90);
  EXPECT_LT(w.at(2)[1], 1.4f);
  EXPECT_TRUE(w.world.getRigidState(5).isAsleep());
  w.world.setSimulationFlag(0);
  w.run(500);
  EXPECT_TRUE(w.world.getRigidState(2).isAwake());
}

TEST(CompatWorld, HL10RaysHitTheNearestBodyOfTheirArea) {
  Owned w;
  for (int i = 0; i < 20; ++i) w.addBox(PfxVector3(0.5f), PfxVector3(3.0f * static_cast<float>(i), 0, 0), kPfxMotionTypeFixed);
  w.run(1);
  std::vector<PfxRayInput> in(20);
  std::vector<PfxRayOutput> out(20);
  for (size_t i = 0; i < in.size(); ++i) {
    in[i].m_startPosition = PfxVector3(3.0f * static_cast<float>(i), 10, 0);
    in[i].m_direction = PfxVector3(0, -20, 0);
  }
  w.world.castRays(in.data(), out.data(), 20);
  for (PfxUInt16 i = 0; i < 20; ++i) {
    ASSERT_TRUE(out[i].m_contactFlag);
    EXPECT_EQ(out[i].m_rigidBodyId, i);
    EXPECT_NEAR(out[i].m_contactPoint[1], 0.5f, 1e-5f);
    PfxRayOutput single;
    w.world.castSingleRay(in[i], single);
    EXPECT_EQ(single.m_variable, out[i].m_variable);
  }
  ASSERT_EQ(w.world.setCastArea(PfxVector3(9, 0, 0), PfxVector3(4.0f)), SCE_PFX_OK);  // boxes 2, 3, 4
  w.world.castRays(in.data(), out.data(), 20);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(out[i].m_contactFlag, i >= 2 && i <= 4) << i;
}

TEST(CompatWorld, HL11OverlapIsWhatBruteForceFinds) {
  Owned w;
  std::mt19937 random(11);
  const auto number = [&](float size) { return size * (static_cast<float>(random() % 2001) / 1000.0f - 1.0f); };
  for (int i = 0; i < 200; ++i) {
    const PfxUInt32 id = w.addBox(PfxVector3(0.5f), PfxVector3(number(10), number(10), number(10)));
    w.world.getRigidState(id).setContactFilterSelf(1u << i % 3);
  }
  for (int trial = 0; trial < 100; ++trial) {
    PfxAabbOverlapInput in;
    in.m_center = PfxVector3(number(10), number(10), number(10));
    in.m_halfExtent = PfxVector3(3.0f);
    in.m_contactFilterTarget = 1u | 2u;
    std::vector<PfxUInt32> expected;
    for (PfxUInt32 i = 0; i < 200; ++i) {
      const PfxVector3 away = absPerElem(w.at(i) - in.m_center);
      if (i % 3 != 2 && maxElem(away) <= 3.5f) expected.push_back(i);
    }
    PfxUInt32 ids[200], count = 0;
    ASSERT_EQ(w.world.findAabbOverlap(in, ids, count, 200), SCE_PFX_OK);
    ASSERT_EQ(std::vector<PfxUInt32>(ids, ids + count), expected);
    if (expected.empty()) continue;
    EXPECT_EQ(w.world.findAabbOverlap(in, ids, count, static_cast<PfxUInt32>(expected.size()) - 1), SCE_PFX_ERR_OUT_OF_BUFFER);
    EXPECT_EQ(count, expected.size() - 1);
  }
}

TEST(CompatWorld, HL12PairsThatAreKeptApartDoNotCollide) {
  Owned w;
  for (int i = 0; i < 40; ++i) w.addBox(PfxVector3(0.5f), PfxVector3(0.6f * static_cast<float>(i), 0, 0));
  for (PfxUInt32 i = 0; i + 1 < 40; ++i) ASSERT_EQ(w.world.appendNonContactPair(i % 2 ? i : i + 1, i % 2 ? i + 1 : i), SCE_PFX_OK);
  EXPECT_EQ(w.world.appendNonContactPair(1, 0), SCE_PFX_ERR_INVALID_VALUE);  // there already
  EXPECT_EQ(w.world.getNonContactPairCount(), 39u);
  for (PfxUInt32 i = 0; i < 40; ++i)
    for (PfxUInt32 k = 0; k < 40; ++k) EXPECT_EQ(w.world.checkNonContactPair(i, k), i + 1 == k || k + 1 == i) << i << " " << k;
  w.run(3);
  EXPECT_EQ(w.world.getContactCount(), 0u);
  for (PfxUInt32 i = 0; i + 1 < 40; ++i) {
    EXPECT_EQ(w.world.removeNonContactPair(i, i + 1), SCE_PFX_OK);
    EXPECT_EQ(w.world.getNonContactPairCount(), 38u - i);
    for (PfxUInt32 k = i + 1; k + 1 < 40; ++k) ASSERT_TRUE(w.world.checkNonContactPair(k, k + 1));
  }
  EXPECT_EQ(w.world.removeNonContactPair(0, 1), SCE_PFX_ERR_INVALID_VALUE);
  w.run(1);
  EXPECT_EQ(w.world.getContactCount(), 39u);
}

TEST(CompatWorld, HL13ACompoundOfSixtyFourShapesComesFromTheStore) {
  Owned w;
  w.addGround();
  PfxCollidable collidable;
  ASSERT_EQ(w.world.setupCollidable(collidable, 64), SCE_PFX_OK);
  for (int i = 0; i < 64; ++i) {
    PfxShape shape;
    shape.setSphere(PfxSphere(0.1f));
    shape.setOffsetPosition(PfxVector3(0.2f * static_cast<float>(i % 8) - 0.7f, 0, 0.2f * static_cast<float>(i / 8) - 0.7f));
    ASSERT_EQ(collidable.addShape(shape), SCE_PFX_OK);
  }
  ASSERT_EQ(collidable.finish(), SCE_PFX_OK);
  PfxRigidState state;
  state.setPosition(PfxVector3(0, 0.1f, 0));
  const PfxUInt32 id = w.world.addRigidBody(state, PfxRigidBody(), collidable);
  w.run(60);
  EXPECT_NEAR(w.at(id)[1], 0.1f, 0.005f);
  PfxCollidable second;
  EXPECT_EQ(w.world.setupCollidable(second, 37), SCE_PFX_ERR_OUT_OF_BUFFER);  // 36 are left
  EXPECT_EQ(w.world.setupCollidable(second, 36), SCE_PFX_OK);
  EXPECT_EQ(w.world.setupCollidable(second, 65), SCE_PFX_ERR_OUT_OF_RANGE);
  EXPECT_EQ(w.world.releaseCollidable(second), SCE_PFX_OK);
  EXPECT_EQ(w.world.releaseCollidable(second), SCE_PFX_ERR_INVALID_VALUE);  // has none
  EXPECT_EQ(w.world.releaseCollidable(w.world.getCollidable(id)), SCE_PFX_OK);
  EXPECT_EQ(w.world.setupCollidable(second, 64), SCE_PFX_OK);
}

int boxes_drawn = 0;

TEST(CompatWorld, HL14IslandsCanBeDrawn) {
  Owned w;
  EXPECT_EQ(w.world.getIsland(), nullptr);
  w.addGround();
  for (int i = 0; i < 4; ++i) w.addBox(PfxVector3(0.5f), PfxVector3(i < 2 ? 0.0f : 5.0f, 0.5f + static_cast<float>(i % 2), 0));
  w.run(1);
  ASSERT_NE(w.world.getIsland(), nullptr);
  EXPECT_EQ(pfxGetNumIslands(w.world.getIsland()), 3u);  // two columns and the ground
  PfxDebugRender render;
  render.setDebugRenderAabbFunc([](const PfxVector3&, const PfxVector3&, const PfxVector3&) { ++boxes_drawn; });
  render.renderIsland(w.world.getIsland(), w.world.getRigidStateArray(), w.world.getCollidableArray());
  EXPECT_EQ(boxes_drawn, 3);
}

TEST(CompatWorld, TaskManagersDoNotChangeABit) {
  alignas(16) char buffer[1024];
  PfxTaskManager tasks(3, 3, buffer, sizeof buffer);
  ASSERT_EQ(tasks.initialize(), SCE_PFX_OK);
  Owned worlds[2];
  worlds[1].world.setTaskManager(&tasks);
  for (Owned& w : worlds) {
    w.addGround();
    for (int i = 0; i < 300; ++i)
      w.addBox(PfxVector3(0.4f), PfxVector3(0.9f * static_cast<float>(i % 10), 0.5f + 0.7f * static_cast<float>(i / 50), 0.9f * static_cast<float>(i / 10 % 5)));
    w.run(60);
  }
  for (PfxUInt32 i = 0; i <= 300; ++i)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(worlds[0].at(i)[k], worlds[1].at(i)[k]) << i;
}

}  // namespace
