// Simulating takes no memory: all of it comes from the application.
#include <gtest/gtest.h>

#include <vector>

#include "compat/physics_effects.h"
#include "tests/support/counted_allocations.h"

using namespace sce::PhysicsEffects;

namespace {

// Fixed arrays, as a program of the overview has them: 21 boxes in piles on a mesh.
struct Program {
  static constexpr PfxUInt32 kBodies = 22, kPairs = 256;
  PfxRigidState states[kBodies];
  PfxRigidBody bodies[kBodies];
  PfxCollidable collidables[kBodies];
  PfxSolverBody solver_bodies[kBodies];
  PfxBroadphaseProxy proxies[kBodies], proxy_work[kBodies];
  PfxContactManifold contacts[kPairs];
  PfxBroadphasePair pairs[kPairs];
  PfxUInt32 num_pairs = 0, num_contacts = 0;
  alignas(16) char work[1 << 16], pair_buffer[1 << 16], decompose_buffer[1 << 16];

  void add(PfxUInt16 id, const PfxShape& shape, const PfxVector3& position, ePfxMotionType type) {
    collidables[id].addShape(shape);
    EXPECT_EQ(collidables[id].finish(), SCE_PFX_OK);
    bodies[id].setInertia(pfxCalcInertiaBox(PfxVector3(0.5f), 1.0f));
    states[id].setPosition(position);
    states[id].setMotionType(type);
    states[id].setRigidBodyId(id);
  }

  void updatePairs() {
    for (PfxUInt32 i = 0; i < kBodies; ++i)
      pfxUpdateBroadphaseProxy(proxies[i], states[i], collidables[i], PfxVector3(0.0f), PfxVector3(500.0f), 0);
    pfxParallelSort(proxies, kBodies, proxy_work, sizeof proxy_work);
    PfxFindPairsParam find;
    find.workBuff = work, find.workBytes = sizeof work, find.pairBuff = pair_buffer, find.pairBytes = sizeof pair_buffer;
    find.proxies = proxies, find.numProxies = kBodies, find.maxPairs = kPairs, find.axis = 0;
    PfxFindPairsResult found;
    ASSERT_EQ(pfxFindPairs(find, found), SCE_PFX_OK);
    PfxDecomposePairsParam split;
    split.workBuff = work, split.workBytes = sizeof work, split.pairBuff = decompose_buffer, split.pairBytes = sizeof decompose_buffer;
    split.previousPairs = pairs, split.numPreviousPairs = num_pairs;
    split.currentPairs = found.pairs, split.numCurrentPairs = found.numPairs;
    PfxDecomposePairsResult result;
    ASSERT_EQ(pfxDecomposePairs(split, result), SCE_PFX_OK);
    num_pairs = 0;
    for (PfxUInt32 i = 0; i < result.numOutKeepPairs; ++i) pairs[num_pairs++] = result.outKeepPairs[i];
    for (PfxUInt32 i = 0; i < result.numOutNewPairs; ++i) {
      ASSERT_LT(num_contacts, kPairs);
      contacts[num_contacts].reset(pfxGetRigidBodyIdA(result.outNewPairs[i]), pfxGetRigidBodyIdB(result.outNewPairs[i]));
      pfxSetContactId(result.outNewPairs[i], num_contacts++);
      pairs[num_pairs++] = result.outNewPairs[i];
    }
    pfxParallelSort(pairs, num_pairs, work, sizeof work);
  }

  void step() {
    for (PfxUInt32 i = 0; i < kBodies; ++i)
      pfxApplyExternalForce(states[i], bodies[i], PfxVector3(0, -9.8f, 0), PfxVector3(0.0f), 0.016f);
    updatePairs();
    PfxRefreshContactsParam refresh;
    refresh.contactPairs = pairs, refresh.numContactPairs = num_pairs, refresh.offsetContactManifolds = contacts;
    refresh.offsetRigidStates = states, refresh.numRigidBodies = kBodies;
    ASSERT_EQ(pfxRefreshContacts(refresh), SCE_PFX_OK);
    PfxDetectCollisionParam detect;
    detect.contactPairs = pairs, detect.numContactPairs = num_pairs, detect.offsetContactManifolds = contacts;
    detect.offsetRigidStates = states, detect.offsetCollidables = collidables, detect.numRigidBodies = kBodies;
    ASSERT_EQ(pfxDetectCollision(detect), SCE_PFX_OK);
    PfxSetupSolverBodiesParam setup;
    setup.states = states, setup.bodies = bodies, setup.solverBodies = solver_bodies, setup.numRigidBodies = kBodies;
    ASSERT_EQ(pfxSetupSolverBodies(setup), SCE_PFX_OK);
    PfxSetupContactConstraintsParam contact;
    contact.contactPairs = pairs, contact.numContactPairs = num_pairs, contact.offsetContactManifolds = contacts;
    contact.offsetRigidStates = states, contact.offsetRigidBodies = bodies, contact.offsetSolverBodies = solver_bodies;
    contact.numRigidBodies = kBodies, contact.timeStep = 0.016f;
    ASSERT_EQ(pfxSetupContactConstraints(contact), SCE_PFX_OK);
    PfxSolveConstraintsParam solve;
    solve.workBuff = work, solve.workBytes = sizeof work;
    solve.contactPairs = pairs, solve.numContactPairs = num_pairs, solve.offsetContactManifolds = contacts;
    solve.offsetRigidStates = states, solve.offsetSolverBodies = solver_bodies, solve.numRigidBodies = kBodies;
    ASSERT_EQ(pfxSolveConstraints(solve), SCE_PFX_OK);
    PfxUpdateRigidStatesParam update;
    update.states = states, update.bodies = bodies, update.numRigidBodies = kBodies, update.timeStep = 0.016f;
    ASSERT_EQ(pfxUpdateRigidStates(update), SCE_PFX_OK);
  }
};

TEST(CompatMemory, SixHundredStepsTakeNoneFromTheFirstOn) {
  const PfxFloat verts[] = {-20, 0, -20, 20, 0, -20, -20, 0, 20, 20, 0, 20};
  const PfxUInt16 triangles[] = {0, 2, 1, 1, 2, 3};
  PfxCreateLargeTriMeshParam param;
  param.verts = verts, param.numVerts = 4, param.triangles = triangles, param.numTriangles = 2;
  PfxLargeTriMesh mesh;
  ASSERT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_OK);
  static Program program;
  PfxShape ground, box;
  ground.setLargeTriMesh(&mesh);
  box.setBox(PfxBox(PfxVector3(0.5f)));
  program.add(0, ground, PfxVector3(0.0f), kPfxMotionTypeFixed);
  for (PfxUInt16 i = 1; i < Program::kBodies; ++i)
    program.add(i, box, PfxVector3(1.5f * static_cast<PfxFloat>(i % 7), 0.5f + 1.01f * static_cast<PfxFloat>(i / 7), 0), kPfxMotionTypeActive);
  const long before = support::g_allocations;
  for (int i = 0; i < 600; ++i) program.step();
  EXPECT_EQ(support::g_allocations - before, 0);
  EXPECT_GT(program.num_pairs, 20u);
  EXPECT_GT(program.states[1].getPosition()[1], 0.45f);
  pfxReleaseLargeTriMesh(mesh);
}

}  // namespace
