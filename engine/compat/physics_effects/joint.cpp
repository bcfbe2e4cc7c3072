#include "compat/physics_effects/joint.h"

#include <cfloat>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/joint/joint_frame.h"

namespace sce::PhysicsEffects {
namespace {

PfxMatrix3 compat(const pfx::Mat3& m) {
  return PfxMatrix3(PhysicsEffects::compat(pfx::Vec3(m.col(0))), PhysicsEffects::compat(pfx::Vec3(m.col(1))),
                    PhysicsEffects::compat(pfx::Vec3(m.col(2))));
}

// Places a joint without constraints: anchor and axes in both bodies.
bool place(PfxJoint& joint, ePfxJointType type, const PfxRigidState& a, const PfxRigidState& b,
           const PfxJointInitParamBase& param, const pfx::Mat3& axes) {
  const pfx::Mat3 frame = param.enableJointFrame ? native(param.jointFrame) : axes;
  if (!frame.allFinite() || !native(param.anchorPoint).allFinite() || !(frame.determinant() > 0.0f)) return false;
  if (!(param.bias >= 0.0f && param.bias <= 1.0f) || !(param.damping >= 0.0f && param.damping <= 1.0f)) return false;
  const PfxVector3 p = param.anchorPoint;
  joint = PfxJoint();
  joint.m_type = static_cast<PfxUInt8>(type);
  joint.m_rigidBodyIdA = a.getRigidBodyId();
  joint.m_rigidBodyIdB = b.getRigidBodyId();
  joint.m_anchorA = rotate(conj(a.getOrientation()), p - a.getPosition());
  joint.m_anchorB = rotate(conj(b.getOrientation()), p - b.getPosition());
  joint.m_frameA = PfxMatrix3(conj(a.getOrientation())) * compat(frame);
  joint.m_frameB = PfxMatrix3(conj(b.getOrientation())) * compat(frame);
  for (PfxJointConstraint& c : joint.m_constraints) c.m_bias = param.bias;
  return true;
}

void fix(PfxJoint& joint, int first, int last) {
  for (int i = first; i <= last; ++i)
    joint.m_constraints[i].m_lock = SCE_PFX_JOINT_LOCK_FIX, joint.m_constraints[i].m_warmStarting = 1;
}
void limit(PfxJointConstraint& axis, PfxFloat lower, PfxFloat upper, PfxFloat damping) {
  axis.m_lock = lower > upper ? SCE_PFX_JOINT_LOCK_FREE : SCE_PFX_JOINT_LOCK_LIMIT;
  axis.m_movableLowerLimit = lower;
  axis.m_movableUpperLimit = upper;
  axis.m_damping = damping;
  axis.m_warmStarting = 1;
}

}  // namespace

pfx::Joint nativeJoint(const PfxJoint& j) {
  pfx::Joint joint;
  joint.kind = static_cast<pfx::JointKind>(j.m_type);
  joint.cone = j.m_type == kPfxJointSwingtwist;
  joint.anchor_a = native(j.m_anchorA), joint.anchor_b = native(j.m_anchorB);
  joint.frame_a = pfx::Quat(native(j.m_frameA)).normalized();
  joint.frame_b = pfx::Quat(native(j.m_frameB)).normalized();
  for (int i = 0; i < 6; ++i) joint.axis[i] = nativeAxis(j.m_constraints[i]);
  return joint;
}

pfx::AxisConstraint nativeAxis(const PfxJointConstraint& c) {
  pfx::AxisConstraint axis;
  axis.lock = static_cast<pfx::JointLock>(SCE_PFX_MIN(c.m_lock, SCE_PFX_JOINT_LOCK_FIX));
  if (axis.lock == pfx::JointLock::Limit) axis.lower = c.m_movableLowerLimit, axis.upper = c.m_movableUpperLimit;
  axis.bias = c.m_bias, axis.weight = c.m_weight, axis.damping = c.m_damping;
  axis.max_force = c.m_maxImpulse;
  return axis;
}

void PfxJointConstraint::reset() {
  m_lock = SCE_PFX_JOINT_LOCK_FREE;
  m_warmStarting = 1;
  m_movableLowerLimit = m_movableUpperLimit = 0.0f;
  m_bias = 0.2f;
  m_weight = 1.0f;
  m_damping = 0.0f;
  m_maxImpulse = FLT_MAX;
  m_constraintRow = {};
}

PfxInt32 pfxInitializeBallJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                const PfxBallJointInitParam& param) {
  if (!place(joint, kPfxJointBall, a, b, param, pfx::Mat3::Identity())) return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 0, 2);
  for (int i = 3; i < 6; ++i) joint.m_constraints[i].m_damping = param.damping;
  return SCE_PFX_OK;
}

PfxInt32 pfxInitializeSwingTwistJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                      const PfxSwingTwistJointInitParam& param) {
  if (!place(joint, kPfxJointSwingtwist, a, b, param, pfx::frameAround(native(param.twistAxis))))
    return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 0, 2);
  limit(joint.m_constraints[3], param.twistLowerAngle, param.twistUpperAngle, param.damping);
  limit(joint.m_constraints[4], param.swingLowerAngle, param.swingUpperAngle, param.damping);
  return SCE_PFX_OK;
}

PfxInt32 pfxInitializeHingeJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                 const PfxHingeJointInitParam& param) {
  if (!place(joint, kPfxJointHinge, a, b, param, pfx::frameAround(native(param.axis)))) return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 0, 2);
  fix(joint, 4, 5);
  limit(joint.m_constraints[3], param.lowerAngle, param.upperAngle, param.damping);
  return SCE_PFX_OK;
}

PfxInt32 pfxInitializeSliderJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                  const PfxSliderJointInitParam& param) {
  if (!place(joint, kPfxJointSlider, a, b, param, pfx::frameAround(native(param.direction))))
    return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 1, 5);
  limit(joint.m_constraints[0], param.lowerDistance, param.upperDistance, param.damping);
  return SCE_PFX_OK;
}

PfxInt32 pfxInitializeFixedJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                 const PfxFixedJointInitParam& param) {
  if (!place(joint, kPfxJointFix, a, b, param, pfx::Mat3::Identity())) return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 0, 5);
  return SCE_PFX_OK;
}

PfxInt32 pfxInitializeUniversalJoint(PfxJoint& joint, const PfxRigidState& a, const PfxRigidState& b,
                                     const PfxUniversalJointInitParam& param) {
  const pfx::Mat3 axes = pfx::frameAround(native(param.axis), native(param.upVec));
  if (!place(joint, kPfxJointUniversal, a, b, param, axes)) return SCE_PFX_ERR_INVALID_VALUE;
  fix(joint, 0, 3);
  limit(joint.m_constraints[4], param.swing1LowerAngle, param.swing1UpperAngle, param.damping);
  limit(joint.m_constraints[5], param.swing2LowerAngle, param.swing2UpperAngle, param.damping);
  return SCE_PFX_OK;
}

PfxInt32 pfxUpdateJointPairs(PfxConstraintPair& pair, PfxUInt32 jointId, const PfxJoint& joint, const PfxRigidState& stateA,
                             const PfxRigidState& stateB) {
  pair = {};
  pfxSetRigidBodyIdA(pair, joint.m_rigidBodyIdA);
  pfxSetRigidBodyIdB(pair, joint.m_rigidBodyIdB);
  pfxSetMotionMaskA(pair, stateA.getMotionMask());
  pfxSetMotionMaskB(pair, stateB.getMotionMask());
  pfxSetActive(pair, joint.m_active != 0);
  pfxSetConstraintId(pair, jointId);
  pfxSetNumConstraints(pair, joint.m_numConstraints);
  pfxSetKey(pair, pfxCalcUniqueKey(joint.m_rigidBodyIdA, joint.m_rigidBodyIdB));
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
