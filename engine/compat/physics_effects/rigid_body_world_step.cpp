// A step of a world: the stages of the low level over its arrays.
#include <algorithm>
#include <utility>

#include "compat/physics_effects/native.h"
#include "compat/physics_effects/rigid_body_world.h"

namespace sce::PhysicsEffects {

PfxInt32 PfxRigidBodyWorld::simulate() {
  if (!isInitialized()) return SCE_PFX_ERR_INVALID_VALUE;
  PfxInt32 (PfxRigidBodyWorld::*const stages[])() = {&PfxRigidBodyWorld::applyGravity,  &PfxRigidBodyWorld::updatePairs,
                                                     &PfxRigidBodyWorld::updateContacts, &PfxRigidBodyWorld::updateIslands,
                                                     &PfxRigidBodyWorld::solve,          &PfxRigidBodyWorld::updateSleep,
                                                     &PfxRigidBodyWorld::updateStates};
  for (const auto stage : stages)
    if (const PfxInt32 error = (this->*stage)(); error != SCE_PFX_OK) return error;
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::applyGravity() {
  for (PfxUInt32 i = 0; i < num_bodies_; ++i) {
    const PfxInt32 error = pfxApplyExternalForce(states_[i], bodies_[i], bodies_[i].getMass() * p_.gravity, PfxVector3(0.0f), p_.timeStep);
    if (error != SCE_PFX_OK) return error;
  }
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::updateProxies(const PfxVector3& center, const PfxVector3& extent, PfxUInt32 behavior) {
  PfxUpdateBroadphaseProxiesParam param;
  param.workBuff = work_buff_, param.workBytes = work_bytes_;
  param.numRigidBodies = num_bodies_, param.offsetRigidStates = states_, param.offsetCollidables = collidables_;
  param.proxiesX = proxies_[0], param.proxiesY = proxies_[1], param.proxiesZ = proxies_[2];
  param.proxiesXb = proxies_[3], param.proxiesYb = proxies_[4], param.proxiesZb = proxies_[5];
  param.worldCenter = center, param.worldExtent = extent;
  param.outOfWorldBehavior = behavior;
  PfxUpdateBroadphaseProxiesResult result;
  const PfxInt32 error = pfxUpdateBroadphaseProxies(param, result, tasks_);
  num_proxies_ = static_cast<PfxUInt32>(result.numProxies);
  return error;
}

PfxInt32 PfxRigidBodyWorld::findPairs(PfxFindPairsResult& found) {
  PfxVector3 sum(0.0f), sum_of_squares(0.0f);
  for (PfxUInt32 i = 0; i < num_bodies_; ++i) {
    const PfxVector3 x = states_[i].getPosition() - p_.worldCenter;
    sum += x, sum_of_squares += mulPerElem(x, x);
  }
  const PfxVector3 variance = sum_of_squares - mulPerElem(sum, sum) / static_cast<PfxFloat>(std::max(num_bodies_, 1u));
  PfxFindPairsParam param;
  param.workBuff = work_buff_, param.workBytes = work_bytes_;
  param.pairBuff = other_pairs_, param.pairBytes = pfxGetPairBytesOfFindPairs(p_.maxContacts);
  param.axis = variance[0] >= variance[1] && variance[0] >= variance[2] ? 0 : variance[1] >= variance[2] ? 1 : 2;
  param.proxies = proxies_[param.axis], param.numProxies = num_proxies_;
  param.maxPairs = p_.maxContacts;
  const PfxInt32 error = pfxFindPairs(param, found, tasks_);
  if (error != SCE_PFX_OK) return error;
  const auto apart = [this](const PfxBroadphasePair& p) { return checkNonContactPair(pfxGetRigidBodyIdA(p), pfxGetRigidBodyIdB(p)); };
  found.numPairs = static_cast<PfxUInt32>(std::remove_if(found.pairs, found.pairs + found.numPairs, apart) - found.pairs);
  return SCE_PFX_OK;
}

// A pair that comes or goes wakes its bodies.
PfxInt32 PfxRigidBodyWorld::decomposePairs(const PfxFindPairsResult& found) {
  PfxDecomposePairsParam param;
  param.workBuff = work_buff_, param.workBytes = work_bytes_;
  param.pairBuff = split_pairs_, param.pairBytes = pfxGetPairBytesOfDecomposePairs(p_.maxContacts, p_.maxContacts);
  param.previousPairs = pairs_, param.numPreviousPairs = num_pairs_;
  param.currentPairs = found.pairs, param.numCurrentPairs = found.numPairs;
  PfxDecomposePairsResult split;
  if (const PfxInt32 error = pfxDecomposePairs(param, split, tasks_); error != SCE_PFX_OK) return error;
  for (PfxUInt32 i = 0; i < split.numOutRemovePairs; ++i) releaseContact(split.outRemovePairs[i]);
  for (PfxUInt32 i = 0; i < split.numOutNewPairs; ++i) {
    PfxBroadphasePair& pair = split.outNewPairs[i];
    const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
    pfxSetContactId(pair, free_contacts_[--num_free_contacts_]);
    contacts_[pfxGetContactId(pair)].reset(a, b);
    wake(a), wake(b);
  }
  std::merge(split.outKeepPairs, split.outKeepPairs + split.numOutKeepPairs, split.outNewPairs, split.outNewPairs + split.numOutNewPairs,
             other_pairs_, [](const auto& a, const auto& b) { return a.key() < b.key(); });
  std::swap(pairs_, other_pairs_);
  num_pairs_ = found.numPairs;
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::updatePairs() {
  constexpr PfxUInt32 kLeave = SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION | SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY;
  if (const PfxInt32 error = updateProxies(p_.worldCenter, p_.worldExtent, kLeave); error != SCE_PFX_OK) return error;
  PfxFindPairsResult found;
  if (const PfxInt32 error = findPairs(found); error != SCE_PFX_OK) return error;
  return decomposePairs(found);
}

PfxInt32 PfxRigidBodyWorld::updateContacts() {
  PfxRefreshContactsParam refresh;
  refresh.contactPairs = pairs_, refresh.numContactPairs = num_pairs_, refresh.offsetContactManifolds = contacts_;
  refresh.offsetRigidStates = states_, refresh.numRigidBodies = num_bodies_;
  if (const PfxInt32 error = pfxRefreshContacts(refresh, tasks_); error != SCE_PFX_OK) return error;
  PfxDetectCollisionParam detect;
  detect.contactPairs = pairs_, detect.numContactPairs = num_pairs_, detect.offsetContactManifolds = contacts_;
  detect.offsetRigidStates = states_, detect.offsetCollidables = collidables_, detect.numRigidBodies = num_bodies_;
  if (const PfxInt32 error = pfxDetectCollision(detect, tasks_); error != SCE_PFX_OK) return error;
  // Pairs without a point take no part in what follows; the next search for pairs makes them active again.
  for (PfxUInt32 i = 0; i < num_pairs_; ++i) pfxSetActive(pairs_[i], contacts_[pfxGetContactId(pairs_[i])].getNumContacts() > 0);
  return SCE_PFX_OK;
}

PfxUInt32 PfxRigidBodyWorld::updateJointPairs() {
  PfxUInt32 count = 0;
  for (PfxUInt32 i = 0; i < num_joints_; ++i)
    if (!joint_removed_[i])
      pfxUpdateJointPairs(joint_pairs_[count++], i, joints_[i], states_[joints_[i].m_rigidBodyIdA], states_[joints_[i].m_rigidBodyIdB]);
  return count;
}

PfxInt32 PfxRigidBodyWorld::updateIslands() {
  PfxGenerateIslandParam param;
  param.islandBuff = island_buff_, param.islandBytes = island_bytes_;
  param.pairs = pairs_, param.numPairs = num_pairs_, param.numObjects = num_bodies_;
  PfxGenerateIslandResult result;
  if (const PfxInt32 error = pfxGenerateIsland(param, result); error != SCE_PFX_OK) return error;
  island_ = result.island;
  return pfxAppendPairs(island_, joint_pairs_, updateJointPairs());
}

bool PfxRigidBodyWorld::isSlow(const PfxRigidState& s) const {
  return length(s.getLinearVelocity()) < p_.sleepVelocity && length(s.getAngularVelocity()) < p_.sleepVelocity;
}

// An island with bodies asleep and awake wakes; one whose bodies have all been slow for long enough falls asleep.
void PfxRigidBodyWorld::updateSleepOfIsland(PfxUInt32 islandId) {
  bool asleep = false, awake = false, tired = true;
  for (const PfxIslandUnit* u = pfxGetFirstUnitInIsland(island_, islandId); u != nullptr; u = pfxGetNextUnitInIsland(u)) {
    const PfxRigidState& s = states_[pfxGetUnitId(u)];
    (s.isAsleep() ? asleep : awake) = true;
    tired = tired && s.canSleep() && s.getSleepCount() > p_.sleepCount;
  }
  const bool wakes = asleep && awake, sleeps = awake && tired && (p_.simulationFlag & SCE_PFX_ENABLE_SLEEP);
  if (!wakes && !sleeps) return;
  for (const PfxIslandUnit* u = pfxGetFirstUnitInIsland(island_, islandId); u != nullptr; u = pfxGetNextUnitInIsland(u)) {
    PfxRigidState& s = states_[pfxGetUnitId(u)];
    if (wakes) s.wakeup();
    else s.sleep();
  }
}

PfxInt32 PfxRigidBodyWorld::updateSleep() {
  if (island_ == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  // A keyframe body that moves wakes what it touches.
  for (PfxUInt32 i = 0; i < num_pairs_; ++i) {
    const PfxUInt16 a = pfxGetRigidBodyIdA(pairs_[i]), b = pfxGetRigidBodyIdB(pairs_[i]);
    const auto moves = [this](PfxUInt16 id) { return states_[id].getMotionType() == kPfxMotionTypeKeyframe && !isSlow(states_[id]); };
    if (pfxGetActive(pairs_[i]) && (moves(a) || moves(b))) wake(a), wake(b);
  }
  for (PfxUInt32 i = 0; i < num_bodies_; ++i) {
    if (isSlow(states_[i])) states_[i].incrementSleepCount();
    else states_[i].resetSleepCount();
  }
  for (PfxUInt32 i = 0; i < pfxGetNumIslands(island_); ++i) updateSleepOfIsland(i);
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::solve() {
  const PfxUInt32 num_joint_pairs = updateJointPairs();
  PfxSetupSolverBodiesParam setup;
  setup.states = states_, setup.bodies = bodies_, setup.solverBodies = solver_bodies_, setup.numRigidBodies = num_bodies_;
  if (const PfxInt32 error = pfxSetupSolverBodies(setup, tasks_); error != SCE_PFX_OK) return error;
  PfxSetupContactConstraintsParam contacts;
  contacts.contactPairs = pairs_, contacts.numContactPairs = num_pairs_, contacts.offsetContactManifolds = contacts_;
  contacts.offsetRigidStates = states_, contacts.offsetRigidBodies = bodies_, contacts.offsetSolverBodies = solver_bodies_;
  contacts.numRigidBodies = num_bodies_, contacts.timeStep = p_.timeStep, contacts.separateBias = p_.separateBias;
  if (const PfxInt32 error = pfxSetupContactConstraints(contacts, tasks_); error != SCE_PFX_OK) return error;
  PfxSetupJointConstraintsParam joints;
  joints.jointPairs = joint_pairs_, joints.numJointPairs = num_joint_pairs, joints.offsetJoints = joints_;
  joints.offsetRigidStates = states_, joints.offsetRigidBodies = bodies_, joints.offsetSolverBodies = solver_bodies_;
  joints.numRigidBodies = num_bodies_, joints.timeStep = p_.timeStep;
  if (const PfxInt32 error = pfxSetupJointConstraints(joints, tasks_); error != SCE_PFX_OK) return error;
  PfxSolveConstraintsParam param;
  param.workBuff = work_buff_, param.workBytes = work_bytes_;
  param.contactPairs = pairs_, param.numContactPairs = num_pairs_, param.offsetContactManifolds = contacts_;
  param.jointPairs = joint_pairs_, param.numJointPairs = num_joint_pairs, param.offsetJoints = joints_;
  param.offsetRigidStates = states_, param.offsetSolverBodies = solver_bodies_;
  param.numRigidBodies = num_bodies_, param.iteration = p_.iteration;
  return pfxSolveConstraints(param, tasks_);
}

PfxInt32 PfxRigidBodyWorld::updateStates() {
  PfxUpdateRigidStatesParam param;
  param.states = states_, param.bodies = bodies_, param.numRigidBodies = num_bodies_, param.timeStep = p_.timeStep;
  if (const PfxInt32 error = pfxUpdateRigidStates(param, tasks_); error != SCE_PFX_OK) return error;
  return updateProxies(cast_center_, cast_extent_, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY);
}

}  // namespace sce::PhysicsEffects
