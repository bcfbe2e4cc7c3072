// What a world holds: its memory, bodies, joints, pairs kept apart, shapes of compounds, and the questions it answers.
#include "compat/physics_effects/rigid_body_world.h"

#include <algorithm>
#include <new>

#include "compat/physics_effects/native.h"

namespace sce::PhysicsEffects {

// Hands out the pool from front to back; without a pool it only counts.
struct PfxRigidBodyWorld::Pool {
  char* base;
  size_t used = 0;

  template <class T>
  void take(T*& array, size_t count) {
    take(reinterpret_cast<void*&>(array), count * sizeof(T), std::max(alignof(T), size_t{16}));
  }
  void take(void*& memory, size_t bytes, size_t align = 16) {
    used = (used + align - 1) / align * align;
    memory = base == nullptr ? nullptr : base + used;
    used += bytes;
  }

  void takeAll(PfxRigidBodyWorld& w) {
    const PfxRigidBodyWorldParam& p = w.p_;
    take(w.states_, p.maxRigidBodies), take(w.bodies_, p.maxRigidBodies), take(w.collidables_, p.maxRigidBodies);
    take(w.solver_bodies_, p.maxRigidBodies);
    take(w.joints_, p.maxJoints), take(w.joint_pairs_, p.maxJoints);
    take(w.shapes_, p.maxShapes), take(w.contacts_, p.maxContacts);
    for (PfxBroadphaseProxy*& proxies : w.proxies_) take(proxies, p.maxRigidBodies);
    take(w.pairs_, p.maxContacts), take(w.other_pairs_, p.maxContacts), take(w.split_pairs_, 2 * size_t{p.maxContacts});
    take(w.apart_keys_, p.maxNonContactPairs), take(w.free_contacts_, p.maxContacts), take(w.free_bodies_, p.maxRigidBodies);
    take(w.free_joints_, p.maxJoints), take(w.free_shapes_, p.maxShapes);
    take(w.body_removed_, p.maxRigidBodies), take(w.joint_removed_, p.maxJoints);
    w.island_bytes_ = pfxGetIslandBytesOfGenerateIsland(p.maxRigidBodies);
    w.work_bytes_ = std::max({pfxGetWorkBytesOfUpdateBroadphaseProxies(p.maxRigidBodies), pfxGetWorkBytesOfFindPairs(p.maxContacts),
                              pfxGetWorkBytesOfDecomposePairs(p.maxContacts, p.maxContacts),
                              pfxGetWorkBytesOfSolveConstraints(p.maxRigidBodies, p.maxContacts, p.maxJoints)});
    take(w.island_buff_, w.island_bytes_), take(w.work_buff_, w.work_bytes_);
  }
};

namespace {

template <class Id>
void fillFree(Id* ids, PfxUInt32& count, PfxUInt32 capacity) {
  count = capacity;
  for (PfxUInt32 i = 0; i < capacity; ++i) ids[i] = static_cast<Id>(capacity - 1 - i);
}

bool isWorld(const PfxRigidBodyWorldParam& p) {
  return p.maxRigidBodies > 0 && p.maxRigidBodies <= 65535 && p.maxShapes <= 65535 && p.maxContacts > 0 && p.timeStep > 0.0f &&
         p.iteration > 0 && minElem(p.worldExtent) > 0.0f;
}

}  // namespace

PfxUInt32 PfxRigidBodyWorld::getRigidBodyWorldBytes(const PfxRigidBodyWorldParam& param) {
  PfxRigidBodyWorld world(param);
  Pool pool{nullptr};
  pool.takeAll(world);
  return static_cast<PfxUInt32>(pool.used);
}

PfxRigidBodyWorld::PfxRigidBodyWorld(const PfxRigidBodyWorldParam& param)
    : p_(param), cast_center_(param.worldCenter), cast_extent_(param.worldExtent) {}

PfxInt32 PfxRigidBodyWorld::initialize() {
  finalize();
  if (p_.poolBuff == nullptr || !isWorld(p_)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(p_.poolBuff)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (p_.poolBytes < getRigidBodyWorldBytes(p_)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  Pool pool{static_cast<char*>(p_.poolBuff)};
  pool.takeAll(*this);
  for (PfxUInt32 i = 0; i < p_.maxRigidBodies; ++i) new (states_ + i) PfxRigidState, new (bodies_ + i) PfxRigidBody, new (collidables_ + i) PfxCollidable;
  for (PfxUInt32 i = 0; i < p_.maxJoints; ++i) new (joints_ + i) PfxJoint;
  for (PfxUInt32 i = 0; i < p_.maxShapes; ++i) new (shapes_ + i) PfxShape;
  for (PfxUInt32 i = 0; i < p_.maxContacts; ++i) new (contacts_ + i) PfxContactManifold;
  return reset();
}

PfxInt32 PfxRigidBodyWorld::finalize() {
  states_ = nullptr;
  num_bodies_ = num_joints_ = num_pairs_ = num_apart_ = num_proxies_ = 0;
  island_ = nullptr;
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::reset() {
  if (!isInitialized()) return SCE_PFX_ERR_INVALID_VALUE;
  num_bodies_ = num_joints_ = num_pairs_ = num_apart_ = num_proxies_ = num_free_bodies_ = num_free_joints_ = 0;
  island_ = nullptr;
  fillFree(free_contacts_, num_free_contacts_, p_.maxContacts);
  fillFree(free_shapes_, num_free_shapes_, p_.maxShapes);
  cast_center_ = p_.worldCenter, cast_extent_ = p_.worldExtent;
  return SCE_PFX_OK;
}

PfxUInt32 PfxRigidBodyWorld::addRigidBody(const PfxRigidState& state, const PfxRigidBody& body, const PfxCollidable& collidable) {
  if (!isInitialized() || (num_free_bodies_ == 0 && num_bodies_ == p_.maxRigidBodies)) return kInvalidId;
  const PfxUInt32 id = num_free_bodies_ > 0 ? free_bodies_[--num_free_bodies_] : num_bodies_++;
  states_[id] = state, bodies_[id] = body, collidables_[id] = collidable;
  states_[id].setRigidBodyId(static_cast<PfxUInt16>(id));
  body_removed_[id] = 0;
  return id;
}

PfxInt32 PfxRigidBodyWorld::removeRigidBody(PfxUInt32 id) {
  if (!isBody(id)) return SCE_PFX_ERR_OUT_OF_RANGE;
  for (PfxUInt32 j = 0; j < num_joints_; ++j)
    if (!joint_removed_[j] && (joints_[j].m_rigidBodyIdA == id || joints_[j].m_rigidBodyIdB == id)) removeJoint(j);
  dropPairsOf(id);
  num_apart_ = static_cast<PfxUInt32>(std::remove_if(apart_keys_, apart_keys_ + num_apart_, [id](PfxUInt32 key) {
    return (key & 0xffffu) == id || key >> 16 == id;
  }) - apart_keys_);

  PfxShape sphere;
  collidables_[id].reset();
  collidables_[id].addShape(sphere);
  collidables_[id].finish();
  states_[id].reset();
  states_[id].setRigidBodyId(static_cast<PfxUInt16>(id));
  states_[id].setMotionType(kPfxMotionTypeFixed);
  states_[id].setContactFilterSelf(0), states_[id].setContactFilterTarget(0);
  states_[id].setPosition(p_.worldCenter + 2.0f * p_.worldExtent + PfxVector3(2.0f));
  body_removed_[id] = 1;
  free_bodies_[num_free_bodies_++] = static_cast<PfxUInt16>(id);
  return SCE_PFX_OK;
}

// So that the next body in this place starts without contacts; what it leaned on wakes.
void PfxRigidBodyWorld::dropPairsOf(PfxUInt32 id) {
  PfxUInt32 kept = 0;
  for (PfxUInt32 i = 0; i < num_pairs_; ++i) {
    const PfxUInt16 a = pfxGetRigidBodyIdA(pairs_[i]), b = pfxGetRigidBodyIdB(pairs_[i]);
    if (a == id || b == id) releaseContact(pairs_[i]);
    else pairs_[kept++] = pairs_[i];
  }
  num_pairs_ = kept;
}

void PfxRigidBodyWorld::releaseContact(const PfxBroadphasePair& pair) {
  free_contacts_[num_free_contacts_++] = pfxGetContactId(pair);
  wake(pfxGetRigidBodyIdA(pair)), wake(pfxGetRigidBodyIdB(pair));
}

PfxUInt32 PfxRigidBodyWorld::addJoint(const PfxJoint& joint) {
  if (!isBody(joint.m_rigidBodyIdA) || !isBody(joint.m_rigidBodyIdB)) return kInvalidId;
  if (num_free_joints_ == 0 && num_joints_ == p_.maxJoints) return kInvalidId;
  const PfxUInt32 id = num_free_joints_ > 0 ? free_joints_[--num_free_joints_] : num_joints_++;
  joints_[id] = joint;
  joint_removed_[id] = 0;
  wake(joint.m_rigidBodyIdA), wake(joint.m_rigidBodyIdB);
  return id;
}

PfxInt32 PfxRigidBodyWorld::updateJoint(PfxUInt32 id, const PfxJoint& joint) {
  if (id >= num_joints_ || joint_removed_[id]) return SCE_PFX_ERR_OUT_OF_RANGE;
  if (!isBody(joint.m_rigidBodyIdA) || !isBody(joint.m_rigidBodyIdB)) return SCE_PFX_ERR_INVALID_VALUE;
  wake(joints_[id].m_rigidBodyIdA), wake(joints_[id].m_rigidBodyIdB);
  joints_[id] = joint;
  wake(joint.m_rigidBodyIdA), wake(joint.m_rigidBodyIdB);
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::removeJoint(PfxUInt32 id) {
  if (id >= num_joints_ || joint_removed_[id]) return SCE_PFX_ERR_OUT_OF_RANGE;
  wake(joints_[id].m_rigidBodyIdA), wake(joints_[id].m_rigidBodyIdB);
  joints_[id].m_active = 0;
  joint_removed_[id] = 1;
  free_joints_[num_free_joints_++] = id;
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::appendNonContactPair(PfxUInt32 a, PfxUInt32 b) {
  if (!isBody(a) || !isBody(b)) return SCE_PFX_ERR_OUT_OF_RANGE;
  if (a == b || checkNonContactPair(a, b)) return SCE_PFX_ERR_INVALID_VALUE;
  if (num_apart_ == p_.maxNonContactPairs) return SCE_PFX_ERR_OUT_OF_BUFFER;
  PfxUInt32* const end = apart_keys_ + num_apart_;
  const PfxUInt32 key = pfxCalcUniqueKey(a, b);
  PfxUInt32* const place = std::lower_bound(apart_keys_, end, key);
  std::copy_backward(place, end, end + 1);
  *place = key;
  ++num_apart_;
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::removeNonContactPair(PfxUInt32 a, PfxUInt32 b) {
  if (!checkNonContactPair(a, b)) return SCE_PFX_ERR_INVALID_VALUE;
  PfxUInt32* const end = apart_keys_ + num_apart_;
  PfxUInt32* const place = std::lower_bound(apart_keys_, end, pfxCalcUniqueKey(a, b));
  std::copy(place + 1, end, place);
  --num_apart_;
  return SCE_PFX_OK;
}

bool PfxRigidBodyWorld::checkNonContactPair(PfxUInt32 a, PfxUInt32 b) const {
  return std::binary_search(apart_keys_, apart_keys_ + num_apart_, pfxCalcUniqueKey(a, b));
}

PfxInt32 PfxRigidBodyWorld::setupCollidable(PfxCollidable& collidable, PfxUInt32 numShapes) {
  if (!isInitialized()) return SCE_PFX_ERR_INVALID_VALUE;
  if (numShapes == 0 || numShapes > SCE_PFX_MAX_SHAPES) return SCE_PFX_ERR_OUT_OF_RANGE;
  if (numShapes > num_free_shapes_) return SCE_PFX_ERR_OUT_OF_BUFFER;
  num_free_shapes_ -= numShapes;
  return collidable.reset(shapes_, free_shapes_ + num_free_shapes_, numShapes);
}

PfxInt32 PfxRigidBodyWorld::releaseCollidable(PfxCollidable& collidable) {
  if (!isInitialized() || collidable.getShapeArray() != shapes_) return SCE_PFX_ERR_INVALID_VALUE;
  for (PfxUInt32 i = collidable.getMaxNumShapes(); i-- > 0;) free_shapes_[num_free_shapes_++] = collidable.getShapeId(i);
  collidable.reset();
  return SCE_PFX_OK;
}

PfxInt32 PfxRigidBodyWorld::setCastArea(const PfxVector3& center, const PfxVector3& extent) {
  if (!isInitialized()) return SCE_PFX_ERR_INVALID_VALUE;
  cast_center_ = center, cast_extent_ = extent;
  return updateProxies(center, extent, SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY);
}

void PfxRigidBodyWorld::castSingleRay(const PfxRayInput& ray, PfxRayOutput& out) const { castRays(&ray, &out, 1); }

void PfxRigidBodyWorld::castRays(const PfxRayInput* rays, PfxRayOutput* outs, int numRays) const {
  PfxRayCastParam param;
  param.offsetRigidStates = states_, param.offsetCollidables = collidables_;
  param.proxiesX = proxies_[0], param.proxiesY = proxies_[1], param.proxiesZ = proxies_[2];
  param.proxiesXb = proxies_[3], param.proxiesYb = proxies_[4], param.proxiesZb = proxies_[5];
  param.numProxies = num_proxies_;
  param.rangeCenter = cast_center_, param.rangeExtent = cast_extent_;
  pfxCastRays(rays, outs, numRays, param, numRays > 1 ? tasks_ : nullptr);
}

PfxInt32 PfxRigidBodyWorld::findAabbOverlap(const PfxAabbOverlapInput& in, PfxUInt32* ids, PfxUInt32& numIds, PfxUInt32 maxIds) const {
  numIds = 0;
  if (!isInitialized() || (ids == nullptr && maxIds > 0) || !(minElem(in.m_halfExtent) >= 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  const pfx::Aabb box{native(in.m_center - in.m_halfExtent), native(in.m_center + in.m_halfExtent)};
  for (PfxUInt32 i = 0; i < num_bodies_; ++i) {
    const PfxRigidState& s = states_[i];
    if (body_removed_[i] || !box.overlaps(bodyAabb(s, collidables_[i]))) continue;
    if (!pfx::filtersMatch(in.m_contactFilterSelf, in.m_contactFilterTarget, s.getContactFilterSelf(), s.getContactFilterTarget()))
      continue;
    if (numIds == maxIds) return SCE_PFX_ERR_OUT_OF_BUFFER;
    ids[numIds++] = i;
  }
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
