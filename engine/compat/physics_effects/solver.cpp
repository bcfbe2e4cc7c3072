#include "compat/physics_effects/solver.h"

#include <cmath>
#include <type_traits>

#include "pfx/base_level/rigid_body/rotation_update.h"
#include "compat/physics_effects/solver_pair.h"

namespace sce::PhysicsEffects {
namespace {

static_assert(sizeof(PfxConstraintRow) == sizeof(pfx::ImpulseRow));
static_assert(sizeof(PfxJointRow) == sizeof(pfx::ImpulseJointRow));
static_assert(std::extent_v<decltype(PfxJoint::m_coupling)> == pfx::kNumImpulseCouplings);
static_assert(offsetof(PfxContactPoint, m_constraintRow) - offsetof(PfxContactPoint, m_armA) == offsetof(pfx::ImpulsePoint, rows));
static_assert(offsetof(PfxContactPoint, m_push) - offsetof(PfxContactPoint, m_armA) == offsetof(pfx::ImpulsePoint, push));
static_assert(offsetof(PfxSolverBody, m_inertiaInv) == offsetof(pfx::ImpulseBody, inv_inertia));
static_assert(offsetof(PfxSolverBody, m_pushAngularVelocity) == offsetof(pfx::ImpulseBody, push_w));

struct Surface {
  PfxFloat restitution, separate_bias, time_step;
};

void setupPoints(PfxContactManifold& manifold, const pfx::RigidState& a, const pfx::RigidState& b, const Surface& s,
                 pfx::ImpulsePair pair) {
  const pfx::Mat3 turn_a = a.orientation.toRotationMatrix(), turn_b = b.orientation.toRotationMatrix();
  const pfx::Vec3 linear = a.linear_velocity - b.linear_velocity;
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    PfxContactPoint& cp = manifold.getContactPoint(k);
    const pfx::Vec3 arm_a = turn_a * pfx::Vec3::Map(cp.m_localPointA), arm_b = turn_b * pfx::Vec3::Map(cp.m_localPointB);
    const pfx::Vec3 velocity = linear + a.angular_velocity.cross(arm_a) - b.angular_velocity.cross(arm_b);
    pfx::setupImpulsePoint({arm_a, arm_b, velocity, pfx::Vec3::Map(cp.m_constraintRow[0].m_normal), cp.m_distance,
                            s.restitution, s.separate_bias, s.time_step},
                           pair, impulses(cp));
  }
}

void setupJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b, PfxFloat time_step, pfx::ImpulsePair pair) {
  const pfx::Joint j = nativeJoint(joint);
  const pfx::JointLinearization l =
      pfx::linearizeJoint(j, pfx::toDouble(poseOf(a)), pfx::toDouble(poseOf(b)));
  const PfxVector3 v[] = {a.getLinearVelocity(), a.getAngularVelocity(), b.getLinearVelocity(), b.getAngularVelocity()};
  for (int i = 0; i < 6; ++i) {
    PfxJointConstraint& c = joint.m_constraints[i];
    double rate = 0.0;
    for (int k = 0; k < 6; ++k) rate += l.jacobian.a[i][k] * v[k / 3][k % 3] + l.jacobian.b[i][k] * v[2 + k / 3][k % 3];
    pfx::setupImpulseJointRow({j.axis[i], l.coordinates.value[i], l.jacobian.a[i], l.jacobian.b[i], static_cast<float>(rate),
                               time_step, c.m_warmStarting != 0},
                              pair, impulses(c.m_constraintRow));
  }
  pfx::coupleImpulseRows(pair, impulses(joint));
}

}  // namespace

PfxInt32 pfxSetupSolverBodies(PfxSetupSolverBodiesParam& param, PfxTaskManager* taskManager) {
  if (param.states == nullptr || param.bodies == nullptr || param.solverBodies == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), param.numRigidBodies, kBodyGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxRigidState& state = param.states[i];
      PfxSolverBody& solver = param.solverBodies[i];
      solver = {};
      solver.m_motionType = state.getMotionType();
      pfxStoreQuat(state.getOrientation(), solver.m_orientation);
      if (!pfx::isDynamic(native(state).motion_type) || state.isAsleep()) continue;
      solver.m_massInv = param.bodies[i].getMassInv();
      const pfx::Mat3 r = native(state).orientation.toRotationMatrix();
      pfx::Mat3::Map(solver.m_inertiaInv) = r * columns(param.bodies[i].getInertiaInv()) * r.transpose();
    }
  });
  return SCE_PFX_OK;
}

PfxInt32 pfxSetupContactConstraints(PfxSetupContactConstraintsParam& p, PfxTaskManager* taskManager) {
  if (const PfxInt32 e = check(p, contactsOf(p)); e != SCE_PFX_OK) return e;
  if (!(p.timeStep > 0.0f) || !(p.separateBias >= 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  if (p.numContactPairs > 0 && p.offsetRigidBodies == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), p.numContactPairs, kBodyGrain, [&](pfx::TaskRange range) {
    pfx::ImpulseBody fixed = {};
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = p.contactPairs[i];
      if (!takesPart(pair, p.offsetRigidStates)) continue;
      const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
      const PfxRigidBody &body_a = p.offsetRigidBodies[a], &body_b = p.offsetRigidBodies[b];
      PfxContactManifold& manifold = p.offsetContactManifolds[pfxGetContactId(pair)];
      manifold.setCompositeFriction(std::sqrt(body_a.getFriction() * body_b.getFriction()));
      const Surface surface{0.5f * (body_a.getRestitution() + body_b.getRestitution()), p.separateBias, p.timeStep};
      const SolverPair bodies(p.offsetSolverBodies[a], p.offsetSolverBodies[b], fixed);
      setupPoints(manifold, native(p.offsetRigidStates[a]), native(p.offsetRigidStates[b]), surface, bodies);
    }
  });
  return SCE_PFX_OK;
}

PfxInt32 pfxSetupJointConstraints(PfxSetupJointConstraintsParam& p, PfxTaskManager* taskManager) {
  if (const PfxInt32 e = check(p, jointsOf(p)); e != SCE_PFX_OK) return e;
  if (!(p.timeStep > 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), p.numJointPairs, kBodyGrain, [&](pfx::TaskRange range) {
    pfx::ImpulseBody fixed = {};
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = p.jointPairs[i];
      if (!takesPart(pair, p.offsetRigidStates)) continue;
      const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
      setupJoint(p.offsetJoints[pfxGetConstraintId(pair)], p.offsetRigidStates[a], p.offsetRigidStates[b], p.timeStep,
                 SolverPair(p.offsetSolverBodies[a], p.offsetSolverBodies[b], fixed));
    }
  });
  return SCE_PFX_OK;
}

namespace {

// Share of the velocity that remains after a step. Bodies have mostly the same damping, so the last power is kept.
class Remaining {
 public:
  explicit Remaining(PfxFloat time_step) : steps_(60.0f * time_step) {}
  PfxFloat operator()(PfxFloat damping) {
    if (damping >= 1.0f) return 1.0f;
    if (damping != damping_) damping_ = damping, power_ = pfx::pow(SCE_PFX_MAX(damping, 1e-6f), steps_);
    return power_;
  }

 private:
  PfxFloat steps_, damping_ = 1.0f, power_ = 1.0f;
};

void moveBody(PfxRigidState& state, PfxFloat h, Remaining& remaining) {
  if (state.getMotionType() == kPfxMotionTypeFixed || state.isAsleep()) return;
  const PfxVector3 v = state.getLinearVelocity(), w = state.getAngularVelocity();
  state.setPosition(state.getPosition() + v * h);
  state.setOrientation(normalize(compat(pfx::expMap(native(w * h))) * state.getOrientation()));
  if (!pfx::isDynamic(native(state).motion_type)) return;
  state.setLinearVelocity((v - state.getPassingLinearVelocity()) * remaining(state.getLinearDamping()));
  state.setAngularVelocity((w - state.getPassingAngularVelocity()) * remaining(state.getAngularDamping()));
}

}  // namespace

PfxInt32 pfxIntegrate(PfxRigidState& state, const PfxRigidBody&, PfxFloat timeStep) {
  if (!(timeStep > 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  Remaining remaining(timeStep);
  moveBody(state, timeStep, remaining);
  return SCE_PFX_OK;
}

PfxInt32 pfxUpdateRigidStates(PfxUpdateRigidStatesParam& param, PfxTaskManager* taskManager) {
  if (param.states == nullptr || param.bodies == nullptr || !(param.timeStep > 0.0f)) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::parallelFor(poolOf(taskManager), param.numRigidBodies, kBodyGrain, [&](pfx::TaskRange range) {
    Remaining remaining(param.timeStep);
    for (uint32_t i = range.begin; i < range.end; ++i) moveBody(param.states[i], param.timeStep, remaining);
  });
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
