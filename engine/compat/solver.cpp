#include "compat/solver.h"

#include <cmath>

#include "compat/native.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/low_level/solver/sequential_impulse.h"

namespace sce::PhysicsEffects {
namespace {

static_assert(sizeof(PfxConstraintRow) == sizeof(pfx::ImpulseRow));
static_assert(sizeof(PfxJointRow) == sizeof(pfx::ImpulseJointRow));
static_assert(offsetof(PfxContactPoint, m_constraintRow) - offsetof(PfxContactPoint, m_armA) == offsetof(pfx::ImpulsePoint, rows));
static_assert(offsetof(PfxSolverBody, m_inertiaInv) == offsetof(pfx::ImpulseBody, inv_inertia));

pfx::ImpulsePoint& impulses(PfxContactPoint& p) { return reinterpret_cast<pfx::ImpulsePoint&>(p.m_armA); }
pfx::ImpulseJointRow& impulses(PfxJointRow& row) { return reinterpret_cast<pfx::ImpulseJointRow&>(row); }
pfx::ImpulseBody& impulses(PfxSolverBody& b) { return reinterpret_cast<pfx::ImpulseBody&>(b); }

constexpr uint32_t kGrain = 64;

// The two bodies of a pair. A OneWay body does not push: its partner is replaced by a copy that does not give way.
class SolverPair {
 public:
  SolverPair(PfxSolverBody& a, PfxSolverBody& b)
      : pair_{pushes(b) ? impulses(a) : still(a), pushes(a) ? impulses(b) : still(b)} {}
  operator pfx::ImpulsePair() const { return pair_; }

 private:
  static bool pushes(const PfxSolverBody& body) { return body.m_motionType != kPfxMotionTypeOneWay; }
  pfx::ImpulseBody& still(PfxSolverBody& body) {
    copy_ = impulses(body);
    copy_.inv_mass = 0.0f;
    for (float& x : copy_.inv_inertia) x = 0.0f;
    return copy_;
  }
  pfx::ImpulseBody copy_;
  pfx::ImpulsePair pair_;
};

PfxInt32 checkPairs(const PfxConstraintPair* pairs, PfxUInt32 count, const void* items, PfxUInt32 num_bodies) {
  if (count > 0 && (pairs == nullptr || items == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(pairs)) return SCE_PFX_ERR_INVALID_ALIGN;
  for (PfxUInt32 i = 0; i < count; ++i)
    if (pfxGetRigidBodyIdA(pairs[i]) >= num_bodies || pfxGetRigidBodyIdB(pairs[i]) >= num_bodies)
      return SCE_PFX_ERR_OUT_OF_RANGE;
  return SCE_PFX_OK;
}

bool takesPart(const PfxConstraintPair& pair, const PfxRigidState* states) {
  return pfxGetActive(pair) && solves(states[pfxGetRigidBodyIdA(pair)].getMotionMask(),
                                      states[pfxGetRigidBodyIdB(pair)].getMotionMask());
}

struct Surface {
  PfxFloat restitution, separate_bias, time_step;
};

void setupPoint(PfxContactPoint& cp, const PfxRigidState& a, const PfxRigidState& b, const Surface& s,
                pfx::ImpulsePair pair) {
  const PfxVector3 arm_a = rotate(a.getOrientation(), pfxReadVector3(cp.m_localPointA));
  const PfxVector3 arm_b = rotate(b.getOrientation(), pfxReadVector3(cp.m_localPointB));
  const PfxVector3 velocity = a.getLinearVelocity() + cross(a.getAngularVelocity(), arm_a) - b.getLinearVelocity() -
                              cross(b.getAngularVelocity(), arm_b);
  pfx::setupImpulsePoint({native(arm_a), native(arm_b), native(velocity), native(cp.getNormal()), cp.m_distance,
                          s.restitution, s.separate_bias, s.time_step},
                         pair, impulses(cp));
}

pfx::Joint nativeJoint(const PfxJoint& j) {
  pfx::Joint joint;
  joint.kind = static_cast<pfx::JointKind>(j.m_type);
  joint.cone = j.m_type == kPfxJointSwingtwist;
  joint.anchor_a = native(j.m_anchorA), joint.anchor_b = native(j.m_anchorB);
  joint.frame_a = pfx::Quat(native(j.m_frameA)).normalized();
  joint.frame_b = pfx::Quat(native(j.m_frameB)).normalized();
  for (int i = 0; i < 6; ++i) {  // rows are made for axes on which something can act
    joint.axis[i].lock = static_cast<pfx::JointLock>(SCE_PFX_MIN(j.m_constraints[i].m_lock, SCE_PFX_JOINT_LOCK_FIX));
    joint.axis[i].damping = j.m_constraints[i].m_damping;
  }
  return joint;
}

void setupJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b, PfxFloat time_step, pfx::ImpulsePair pair) {
  const pfx::JointLinearization l =
      pfx::linearizeJoint(nativeJoint(joint), pfx::toDouble(poseOf(a)), pfx::toDouble(poseOf(b)));
  const PfxVector3 v[] = {a.getLinearVelocity(), a.getAngularVelocity(), b.getLinearVelocity(), b.getAngularVelocity()};
  for (int i = 0; i < 6; ++i) {
    PfxJointConstraint& c = joint.m_constraints[i];
    pfx::AxisConstraint axis;
    axis.lock = static_cast<pfx::JointLock>(SCE_PFX_MIN(c.m_lock, SCE_PFX_JOINT_LOCK_FIX));
    axis.lower = c.m_movableLowerLimit, axis.upper = c.m_movableUpperLimit;
    axis.bias = c.m_bias, axis.weight = c.m_weight, axis.damping = c.m_damping;
    axis.max_force = c.m_maxImpulse;
    double rate = 0.0;
    for (int k = 0; k < 6; ++k) rate += l.jacobian.a[i][k] * v[k / 3][k % 3] + l.jacobian.b[i][k] * v[2 + k / 3][k % 3];
    pfx::setupImpulseJointRow({axis, l.coordinates.value[i], l.jacobian.a[i], l.jacobian.b[i], static_cast<float>(rate),
                               time_step, c.m_warmStarting != 0},
                              pair, impulses(c.m_constraintRow));
  }
}

// Calls fn(bodies, item) for all that take part.
template <class Item, class Fn>
void forEachPair(const PfxSolveConstraintsParam& p, const PfxConstraintPair* pairs, PfxUInt32 count, Item* items, Fn&& fn) {
  for (PfxUInt32 i = 0; i < count; ++i) {
    if (!takesPart(pairs[i], p.offsetRigidStates)) continue;
    const SolverPair bodies(p.offsetSolverBodies[pfxGetRigidBodyIdA(pairs[i])],
                            p.offsetSolverBodies[pfxGetRigidBodyIdB(pairs[i])]);
    fn(bodies, items[pfxGetContactId(pairs[i])]);
  }
}

void addChanges(const PfxSolveConstraintsParam& p) {
  for (PfxUInt32 i = 0; i < p.numRigidBodies; ++i) {
    const PfxSolverBody& body = p.offsetSolverBodies[i];
    if (!(body.m_massInv > 0.0f)) continue;
    PfxRigidState& state = p.offsetRigidStates[i];
    state.setLinearVelocity(state.getLinearVelocity() + pfxReadVector3(body.m_deltaLinearVelocity));
    state.setAngularVelocity(state.getAngularVelocity() + pfxReadVector3(body.m_deltaAngularVelocity));
  }
}

}  // namespace

PfxInt32 pfxSetupSolverBodies(PfxSetupSolverBodiesParam& param, PfxTaskManager* taskManager) {
  if (param.states == nullptr || param.bodies == nullptr || param.solverBodies == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), param.numRigidBodies, kGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxRigidState& state = param.states[i];
      PfxSolverBody& solver = param.solverBodies[i];
      solver = {};
      solver.m_motionType = state.getMotionType();
      pfxStoreQuat(state.getOrientation(), solver.m_orientation);
      if (!pfx::isDynamic(native(state).motion_type) || state.isAsleep()) continue;
      solver.m_massInv = param.bodies[i].getMassInv();
      const PfxMatrix3 r(state.getOrientation());
      const PfxMatrix3 inertia = r * param.bodies[i].getInertiaInv() * transpose(r);
      for (int c = 0; c < 3; ++c) pfxStoreVector3(inertia[c], solver.m_inertiaInv + 3 * c);
    }
  });
  return SCE_PFX_OK;
}

PfxInt32 pfxSetupContactConstraints(PfxSetupContactConstraintsParam& p, PfxTaskManager* taskManager) {
  if (const PfxInt32 e = checkPairs(p.contactPairs, p.numContactPairs, p.offsetContactManifolds, p.numRigidBodies); e != SCE_PFX_OK)
    return e;
  if (!(p.timeStep > 0.0f) || !(p.separateBias >= 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  if (p.numContactPairs > 0 && (p.offsetRigidStates == nullptr || p.offsetRigidBodies == nullptr || p.offsetSolverBodies == nullptr))
    return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), p.numContactPairs, kGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = p.contactPairs[i];
      if (!takesPart(pair, p.offsetRigidStates)) continue;
      const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
      const PfxRigidBody &body_a = p.offsetRigidBodies[a], &body_b = p.offsetRigidBodies[b];
      PfxContactManifold& manifold = p.offsetContactManifolds[pfxGetContactId(pair)];
      manifold.setCompositeFriction(std::sqrt(body_a.getFriction() * body_b.getFriction()));
      const Surface surface{0.5f * (body_a.getRestitution() + body_b.getRestitution()), p.separateBias, p.timeStep};
      const SolverPair bodies(p.offsetSolverBodies[a], p.offsetSolverBodies[b]);
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        setupPoint(manifold.getContactPoint(k), p.offsetRigidStates[a], p.offsetRigidStates[b], surface, bodies);
    }
  });
  return SCE_PFX_OK;
}

PfxInt32 pfxSetupJointConstraints(PfxSetupJointConstraintsParam& p, PfxTaskManager* taskManager) {
  if (const PfxInt32 e = checkPairs(p.jointPairs, p.numJointPairs, p.offsetJoints, p.numRigidBodies); e != SCE_PFX_OK) return e;
  if (!(p.timeStep > 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  if (p.numJointPairs > 0 && (p.offsetRigidStates == nullptr || p.offsetSolverBodies == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), p.numJointPairs, kGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = p.jointPairs[i];
      if (!takesPart(pair, p.offsetRigidStates)) continue;
      const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
      setupJoint(p.offsetJoints[pfxGetConstraintId(pair)], p.offsetRigidStates[a], p.offsetRigidStates[b], p.timeStep,
                 SolverPair(p.offsetSolverBodies[a], p.offsetSolverBodies[b]));
    }
  });
  return SCE_PFX_OK;
}

PfxUInt32 pfxGetWorkBytesOfSolveConstraints(PfxUInt32, PfxUInt32, PfxUInt32, PfxUInt32) { return 16; }

PfxInt32 pfxSolveConstraints(PfxSolveConstraintsParam& p, PfxTaskManager*) {
  if (p.workBuff == nullptr || p.iteration == 0) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(p.workBuff)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (p.workBytes < pfxGetWorkBytesOfSolveConstraints(0, 0, 0)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (p.numRigidBodies > 0 && (p.offsetRigidStates == nullptr || p.offsetSolverBodies == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (const PfxInt32 e = checkPairs(p.contactPairs, p.numContactPairs, p.offsetContactManifolds, p.numRigidBodies); e != SCE_PFX_OK)
    return e;
  if (const PfxInt32 e = checkPairs(p.jointPairs, p.numJointPairs, p.offsetJoints, p.numRigidBodies); e != SCE_PFX_OK) return e;

  const auto joints = [&](auto&& fn) { forEachPair(p, p.jointPairs, p.numJointPairs, p.offsetJoints, fn); };
  const auto contacts = [&](auto&& fn) { forEachPair(p, p.contactPairs, p.numContactPairs, p.offsetContactManifolds, fn); };
  joints([](pfx::ImpulsePair bodies, PfxJoint& joint) {
    for (PfxJointConstraint& c : joint.m_constraints) pfx::warmStart(bodies, impulses(c.m_constraintRow));
  });
  contacts([](pfx::ImpulsePair bodies, PfxContactManifold& manifold) {
    for (int k = 0; k < manifold.getNumContacts(); ++k) pfx::warmStart(bodies, impulses(manifold.getContactPoint(k)));
  });
  for (PfxUInt32 i = 0; i < p.iteration; ++i) {
    joints([](pfx::ImpulsePair bodies, PfxJoint& joint) {
      for (PfxJointConstraint& c : joint.m_constraints) pfx::solveImpulses(bodies, impulses(c.m_constraintRow));
    });
    contacts([](pfx::ImpulsePair bodies, PfxContactManifold& manifold) {
      const float friction = manifold.getCompositeFriction();
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        pfx::solveImpulses(bodies, friction, impulses(manifold.getContactPoint(k)));
    });
  }
  addChanges(p);
  return SCE_PFX_OK;
}

PfxInt32 pfxUpdateRigidStates(PfxUpdateRigidStatesParam& param, PfxTaskManager* taskManager) {
  if (param.states == nullptr || param.bodies == nullptr || !(param.timeStep > 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  const PfxFloat h = param.timeStep;
  pfx::parallelFor(poolOf(taskManager), param.numRigidBodies, kGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      PfxRigidState& state = param.states[i];
      const PfxVector3 v = state.getLinearVelocity(), w = state.getAngularVelocity();
      if (state.getMotionType() == kPfxMotionTypeFixed || state.isAsleep()) continue;
      state.setPosition(state.getPosition() + v * h);
      const PfxQuat q = compat(pfx::expMap(native(w * h))) * state.getOrientation();
      state.setOrientation(normalize(q));
      if (!pfx::isDynamic(native(state).motion_type)) continue;
      const auto remaining = [h](PfxFloat damping) { return damping < 1.0f ? pfx::pow(SCE_PFX_MAX(damping, 1e-6f), 60.0f * h) : 1.0f; };
      state.setLinearVelocity(v * remaining(state.getLinearDamping()));
      state.setAngularVelocity(w * remaining(state.getAngularDamping()));
    }
  });
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
