// A world as a program of the overview keeps it: three arrays, pairs from step to step, every buffer its own.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <vector>

#include "compat/physics_effects.h"

namespace compat_tests {

using namespace sce::PhysicsEffects;

// A buffer of exactly so many bytes; whoever writes behind it fails the test.
struct Buffer {
  explicit Buffer(PfxUInt32 size) : bytes(size), data(std::aligned_alloc(16, SCE_PFX_BYTES_ALIGN16(size + kGuard))) {
    std::memset(end(), 0x5a, kGuard);
  }
  ~Buffer() {
    for (PfxUInt32 i = 0; i < kGuard; ++i) EXPECT_EQ(end()[i], 0x5a) << "written behind a buffer of " << bytes << " bytes";
    std::free(data);
  }
  Buffer(const Buffer&) = delete;
  unsigned char* end() { return static_cast<unsigned char*>(data) + bytes; }

  static constexpr PfxUInt32 kGuard = 64;
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
  PfxFloat separate_bias = 0.2f;
  PfxVector3 gravity = PfxVector3(0.0f, -9.8f, 0.0f);

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
    EXPECT_EQ(pfxParallelSort(proxies.data(), n, sorted.data(), n * sizeof(PfxBroadphaseProxy), tasks), SCE_PFX_OK);
    PfxFindPairsParam param;
    param.maxPairs = 4000;
    Buffer work(pfxGetWorkBytesOfFindPairs(param.maxPairs)), pair_buffer(pfxGetPairBytesOfFindPairs(param.maxPairs));
    param.workBuff = work.data, param.workBytes = work.bytes;
    param.pairBuff = pair_buffer.data, param.pairBytes = pair_buffer.bytes;
    param.proxies = proxies.data(), param.numProxies = n;
    param.axis = axis;
    PfxFindPairsResult result;
    EXPECT_EQ(pfxFindPairs(param, result, tasks), SCE_PFX_OK);
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
    EXPECT_EQ(pfxDecomposePairs(param, result, tasks), SCE_PFX_OK);
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
    EXPECT_EQ(pfxSetupSolverBodies(setup, tasks), SCE_PFX_OK);
    PfxSetupContactConstraintsParam contact;
    contact.contactPairs = pairs.data(), contact.numContactPairs = static_cast<PfxUInt32>(pairs.size());
    contact.offsetContactManifolds = contacts.data(), contact.offsetRigidStates = states.data();
    contact.offsetRigidBodies = bodies.data(), contact.offsetSolverBodies = solver_bodies.data();
    contact.numRigidBodies = n, contact.timeStep = time_step, contact.separateBias = separate_bias;
    EXPECT_EQ(pfxSetupContactConstraints(contact, tasks), SCE_PFX_OK);
    std::vector<PfxConstraintPair> joint_pairs(joints.size());
    for (PfxUInt32 i = 0; i < joints.size(); ++i)
      pfxUpdateJointPairs(joint_pairs[i], i, joints[i], states[joints[i].m_rigidBodyIdA], states[joints[i].m_rigidBodyIdB]);
    PfxSetupJointConstraintsParam joint;
    joint.jointPairs = joint_pairs.data(), joint.numJointPairs = static_cast<PfxUInt32>(joints.size());
    joint.offsetJoints = joints.data(), joint.offsetRigidStates = states.data();
    joint.offsetRigidBodies = bodies.data(), joint.offsetSolverBodies = solver_bodies.data();
    joint.numRigidBodies = n, joint.timeStep = time_step;
    EXPECT_EQ(pfxSetupJointConstraints(joint, tasks), SCE_PFX_OK);
    PfxSolveConstraintsParam param;
    Buffer work(pfxGetWorkBytesOfSolveConstraints(n, contact.numContactPairs, joint.numJointPairs));
    param.workBuff = work.data, param.workBytes = work.bytes;
    param.contactPairs = pairs.data(), param.numContactPairs = contact.numContactPairs;
    param.offsetContactManifolds = contacts.data();
    param.jointPairs = joint_pairs.data(), param.numJointPairs = joint.numJointPairs, param.offsetJoints = joints.data();
    param.offsetRigidStates = states.data(), param.offsetSolverBodies = solver_bodies.data();
    param.numRigidBodies = n, param.iteration = iterations;
    EXPECT_EQ(pfxSolveConstraints(param, tasks), SCE_PFX_OK);
  }

  void step(PfxFloat time_step = 0.016f, PfxUInt32 iterations = 10) {
    const PfxUInt32 n = static_cast<PfxUInt32>(states.size());
    for (PfxUInt32 i = 0; i < n; ++i)
      pfxApplyExternalForce(states[i], bodies[i], bodies[i].getMass() * gravity, PfxVector3(0.0f), time_step);
    updatePairs();
    collide();
    solve(time_step, iterations);
    PfxUpdateRigidStatesParam update;
    update.states = states.data(), update.bodies = bodies.data();
    update.numRigidBodies = n, update.timeStep = time_step;
    EXPECT_EQ(pfxUpdateRigidStates(update, tasks), SCE_PFX_OK);
  }
};

}  // namespace compat_tests
