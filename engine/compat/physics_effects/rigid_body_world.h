// The high level: a world that keeps bodies, joints and contacts in one block of memory of the application, and runs the
// stages in their order.
#pragma once

#include "island.h"
#include "ray.h"
#include "solver.h"

#define SCE_PFX_ENABLE_SLEEP 0x01u  // islands at rest fall asleep

namespace sce {
namespace PhysicsEffects {

// How much a world has room for, and how it is simulated.
struct PfxRigidBodyWorldParam {
  // Room for bodies, joints, shapes and pairs; the world; the solver; sleep; the block of memory.
  PfxUInt32 maxRigidBodies = 500;  // up to 65535
  PfxUInt32 maxJoints = 500;
  PfxUInt32 maxShapes = 100;           // of bodies with several shapes
  PfxUInt32 maxContacts = 4000;        // pairs of bodies whose bounds meet
  PfxUInt32 maxNonContactPairs = 100;
  PfxVector3 worldCenter = PfxVector3(0.0f);               // m
  PfxVector3 worldExtent = PfxVector3(500.0f);             // m, half the size
  PfxVector3 gravity = PfxVector3(0.0f, -9.8f, 0.0f);      // m/s^2
  PfxFloat timeStep = 1.0f / 60.0f;                        // s
  PfxFloat separateBias = 0.2f;
  PfxUInt32 iteration = 5;
  PfxUInt32 sleepCount = 180;       // steps that an island must be slow before it falls asleep
  PfxFloat sleepVelocity = 0.1f;    // m/s and rad/s, what is slow
  PfxUInt32 simulationFlag = 0;     // SCE_PFX_ENABLE_SLEEP
  void* poolBuff = nullptr;         // aligned to 16 bytes, as long as the world lives
  PfxUInt32 poolBytes = 0;          // at least PfxRigidBodyWorld::getRigidBodyWorldBytes()
};

// A box to look for bodies in.
struct PfxAabbOverlapInput {
  PfxVector3 m_center = PfxVector3(0.0f);      // m
  PfxVector3 m_halfExtent = PfxVector3(0.0f);  // m
  // As those of a body.
  PfxUInt32 m_contactFilterSelf = 0xffffffffu;
  PfxUInt32 m_contactFilterTarget = 0xffffffffu;
};

// Ids of bodies and joints stay the same until they are removed; a new one takes the place of one that was. Accessors abort
// on an id that is out of range. The arrays may also be given to the low level between two steps.
class PfxRigidBodyWorld {
 public:
  enum : PfxUInt32 { kInvalidId = 0xffffffffu };

  // Bytes of the pool for a world of these parameters.
  static PfxUInt32 getRigidBodyWorldBytes(const PfxRigidBodyWorldParam& param);

  // Keeps the parameters; initialize() makes the world.
  explicit PfxRigidBodyWorld(const PfxRigidBodyWorldParam& param);
  PfxRigidBodyWorld(const PfxRigidBodyWorld&) = delete;
  PfxRigidBodyWorld& operator=(const PfxRigidBodyWorld&) = delete;

  // Makes the empty world in the pool. SCE_PFX_ERR_INVALID_VALUE: no pool, or parameters that make no world;
  // _INVALID_ALIGN; _OUT_OF_BUFFER: the pool is too small. Nothing below works before it has succeeded.
  PfxInt32 initialize();
  // Gives the pool back.
  PfxInt32 finalize();
  // Removes everything that was added.
  PfxInt32 reset();
  bool isInitialized() const { return states_ != nullptr; }
  // Threads for the stages; NULL: none. The results are the same.
  void setTaskManager(PfxTaskManager* tasks) { tasks_ = tasks; }

  // One step: the stages below one after the other. The error of the first one that fails; SCE_PFX_ERR_OUT_OF_MAX_PAIRS: more
  // than maxContacts pairs.
  PfxInt32 simulate();
  PfxInt32 applyGravity();
  PfxInt32 updatePairs();      // broad phase; bodies outside of the world become Fixed and meet nobody
  PfxInt32 updateContacts();
  PfxInt32 updateIslands();
  PfxInt32 solve();
  PfxInt32 updateSleep();      // wakes, and with SCE_PFX_ENABLE_SLEEP puts to sleep
  PfxInt32 updateStates();     // moves

  // The id, which is also set in the state; kInvalidId when there is no room.
  PfxUInt32 addRigidBody(const PfxRigidState& state, const PfxRigidBody& body, const PfxCollidable& collidable);
  // The body becomes a fixed sphere outside of the world; its joints and non-contact pairs go with it.
  PfxInt32 removeRigidBody(PfxUInt32 bodyId);
  bool isRemovedRigidBody(PfxUInt32 bodyId) const { return at(bodyId, num_bodies_), body_removed_[bodyId] != 0; }

  // The id; kInvalidId when there is no room, or a body of the joint is not there.
  PfxUInt32 addJoint(const PfxJoint& joint);
  // Puts another joint in the place of one.
  PfxInt32 updateJoint(PfxUInt32 jointId, const PfxJoint& joint);
  PfxInt32 removeJoint(PfxUInt32 jointId);
  bool isRemovedJoint(PfxUInt32 jointId) const { return at(jointId, num_joints_), joint_removed_[jointId] != 0; }

  // Ids are below the count; removed ones are counted.
  PfxUInt32 getRigidBodyCount() const { return num_bodies_; }
  PfxUInt32 getJointCount() const { return num_joints_; }
  PfxUInt32 getContactCount() const { return num_pairs_; }  // pairs of bodies
  PfxUInt32 getNonContactPairCount() const { return num_apart_; }
  PfxUInt32 getRigidBodyCapacity() const { return p_.maxRigidBodies; }
  PfxUInt32 getJointCapacity() const { return p_.maxJoints; }
  PfxUInt32 getShapeCapacity() const { return p_.maxShapes; }
  PfxUInt32 getContactCapacity() const { return p_.maxContacts; }
  PfxUInt32 getNonContactPairCapacity() const { return p_.maxNonContactPairs; }

  // By id.
  PfxRigidState& getRigidState(PfxUInt32 id) { return states_[at(id, num_bodies_)]; }
  const PfxRigidState& getRigidState(PfxUInt32 id) const { return states_[at(id, num_bodies_)]; }
  PfxRigidBody& getRigidBody(PfxUInt32 id) { return bodies_[at(id, num_bodies_)]; }
  const PfxRigidBody& getRigidBody(PfxUInt32 id) const { return bodies_[at(id, num_bodies_)]; }
  PfxCollidable& getCollidable(PfxUInt32 id) { return collidables_[at(id, num_bodies_)]; }
  const PfxCollidable& getCollidable(PfxUInt32 id) const { return collidables_[at(id, num_bodies_)]; }
  PfxJoint& getJoint(PfxUInt32 id) { return joints_[at(id, num_joints_)]; }
  const PfxJoint& getJoint(PfxUInt32 id) const { return joints_[at(id, num_joints_)]; }
  // Of the i-th pair, i below getContactCount().
  const PfxContactManifold& getContactManifold(PfxUInt32 i) const { return contacts_[pfxGetContactId(getContactPair(i))]; }
  const PfxBroadphasePair& getContactPair(PfxUInt32 i) const { return pairs_[at(i, num_pairs_)]; }
  PfxRigidState* getRigidStateArray() { return states_; }
  PfxRigidBody* getRigidBodyArray() { return bodies_; }
  PfxCollidable* getCollidableArray() { return collidables_; }
  PfxJoint* getJointArray() { return joints_; }
  PfxBroadphasePair* getContactPairArray() { return pairs_; }
  PfxContactManifold* getContactManifoldArray() { return contacts_; }
  // Of the last step; NULL before the first.
  const PfxIsland* getIsland() const { return island_; }

  // Take effect in the next step.
  const PfxVector3& getGravity() const { return p_.gravity; }
  void setGravity(const PfxVector3& gravity) { p_.gravity = gravity; }
  PfxFloat getTimeStep() const { return p_.timeStep; }
  void setTimeStep(PfxFloat timeStep) { p_.timeStep = timeStep; }
  PfxFloat getSeparateBias() const { return p_.separateBias; }
  void setSeparateBias(PfxFloat bias) { p_.separateBias = bias; }
  PfxUInt32 getIteration() const { return p_.iteration; }
  void setIteration(PfxUInt32 iteration) { p_.iteration = iteration; }
  const PfxVector3& getWorldCenter() const { return p_.worldCenter; }
  const PfxVector3& getWorldExtent() const { return p_.worldExtent; }
  void setWorldCenter(const PfxVector3& center) { p_.worldCenter = center; }
  void setWorldExtent(const PfxVector3& extent) { p_.worldExtent = extent; }
  PfxUInt32 getSleepCount() const { return p_.sleepCount; }
  void setSleepCount(PfxUInt32 steps) { p_.sleepCount = steps; }
  PfxFloat getSleepVelocity() const { return p_.sleepVelocity; }
  void setSleepVelocity(PfxFloat velocity) { p_.sleepVelocity = velocity; }
  PfxUInt32 getSimulationFlag() const { return p_.simulationFlag; }
  void setSimulationFlag(PfxUInt32 flag) { p_.simulationFlag = flag; }

  // Rays see bodies as they stood after the last step, or at the last setCastArea(), and only those whose bounds meet the area.
  // Before the first of both they hit nothing.
  PfxInt32 setCastArea(const PfxVector3& center, const PfxVector3& extent);
  void castSingleRay(const PfxRayInput& ray, PfxRayOutput& out) const;
  void castRays(const PfxRayInput* rays, PfxRayOutput* outs, int numRays) const;
  // Ids of the bodies whose bounds meet the box and whose filters admit it, ascending. SCE_PFX_ERR_OUT_OF_BUFFER: there are
  // more than maxIds; the first ones are in `ids` then.
  PfxInt32 findAabbOverlap(const PfxAabbOverlapInput& input, PfxUInt32* ids, PfxUInt32& numIds, PfxUInt32 maxIds) const;

  // Pairs of bodies that never collide. SCE_PFX_ERR_OUT_OF_BUFFER: no room; SCE_PFX_ERR_INVALID_VALUE: there already, or not
  // there.
  PfxInt32 appendNonContactPair(PfxUInt32 bodyIdA, PfxUInt32 bodyIdB);
  PfxInt32 removeNonContactPair(PfxUInt32 bodyIdA, PfxUInt32 bodyIdB);
  bool checkNonContactPair(PfxUInt32 bodyIdA, PfxUInt32 bodyIdB) const;

  // Prepares a collidable for numShapes shapes (1 .. 64) from the world's own store: then addShape() and finish().
  // SCE_PFX_ERR_OUT_OF_BUFFER: not so many are left.
  PfxInt32 setupCollidable(PfxCollidable& collidable, PfxUInt32 numShapes);
  // Gives them back; the collidable is empty then.
  PfxInt32 releaseCollidable(PfxCollidable& collidable);

 private:
  struct Pool;
  template <class Id>
  static Id at(Id i, PfxUInt32 count) {
    SCE_PFX_ALWAYS_ASSERT_MSG(i < count, "an id that is out of range");
    return i;
  }
  bool isBody(PfxUInt32 id) const { return id < num_bodies_ && !body_removed_[id]; }
  void wake(PfxUInt32 bodyId) { states_[bodyId].wakeup(); }
  void dropPairsOf(PfxUInt32 bodyId);
  void releaseContact(const PfxBroadphasePair& pair);
  PfxInt32 updateProxies(const PfxVector3& center, const PfxVector3& extent, PfxUInt32 behavior);
  PfxInt32 findPairs(PfxFindPairsResult& found);
  PfxInt32 decomposePairs(const PfxFindPairsResult& found);
  PfxUInt32 updateJointPairs();
  bool isSlow(const PfxRigidState& state) const;
  void updateSleepOfIsland(PfxUInt32 islandId);

  PfxRigidBodyWorldParam p_;
  PfxTaskManager* tasks_ = nullptr;
  PfxVector3 cast_center_, cast_extent_;

  // In the pool.
  PfxRigidState* states_ = nullptr;
  PfxRigidBody* bodies_ = nullptr;
  PfxCollidable* collidables_ = nullptr;
  PfxSolverBody* solver_bodies_ = nullptr;
  PfxJoint* joints_ = nullptr;
  PfxConstraintPair* joint_pairs_ = nullptr;
  PfxShape* shapes_ = nullptr;
  PfxContactManifold* contacts_ = nullptr;
  PfxBroadphaseProxy* proxies_[6] = {};
  PfxBroadphasePair *pairs_ = nullptr, *other_pairs_ = nullptr, *split_pairs_ = nullptr;
  PfxUInt32* apart_keys_ = nullptr;      // ascending
  PfxUInt32* free_contacts_ = nullptr;   // the last one is taken first
  PfxUInt16* free_bodies_ = nullptr;
  PfxUInt32* free_joints_ = nullptr;
  PfxUInt16* free_shapes_ = nullptr;
  PfxUInt8 *body_removed_ = nullptr, *joint_removed_ = nullptr;
  void *island_buff_ = nullptr, *work_buff_ = nullptr;
  PfxUInt32 island_bytes_ = 0, work_bytes_ = 0;

  PfxUInt32 num_bodies_ = 0, num_joints_ = 0, num_pairs_ = 0, num_apart_ = 0, num_proxies_ = 0;
  PfxUInt32 num_free_contacts_ = 0, num_free_bodies_ = 0, num_free_joints_ = 0, num_free_shapes_ = 0;
  PfxIsland* island_ = nullptr;
};

}  // namespace PhysicsEffects
}  // namespace sce
