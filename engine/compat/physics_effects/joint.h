// Joints: six axis constraints between two bodies, and the kinds that are made of them.
#pragma once

#include "broadphase.h"

// Of an axis.
#define SCE_PFX_JOINT_LOCK_FREE 0   // free in the whole
#define SCE_PFX_JOINT_LOCK_LIMIT 1  // free within the movable range
#define SCE_PFX_JOINT_LOCK_FIX 2    // fixed where it stood when the joint was made, whatever the range

namespace sce {
namespace PhysicsEffects {

// Kinds of joints. They differ in the axes that they lock; the kind only says how a joint was made.
enum ePfxJointType {
  kPfxJointBall = 0,
  kPfxJointSwingtwist,
  kPfxJointSwingTwist = kPfxJointSwingtwist,
  kPfxJointHinge,
  kPfxJointSlider,
  kPfxJointFix,
  kPfxJointFixed = kPfxJointFix,
  kPfxJointUniversal,
  kPfxJointCount
};

// A row of the solver.
struct PfxJointRow {
  // As the solver keeps it: N s for right side, limits and impulse, kg or kg m^2 for m_jacDiagInv.
  PfxFloat m_jacobian[12];
  PfxFloat m_rhs, m_jacDiagInv, m_lowerLimit, m_upperLimit;
  PfxFloat m_accumImpulse;
  PfxFloat m_weight;
  PfxFloat m_softness;
};

// One axis: m and N s for translations, rad and N m s for rotations.
struct PfxJointConstraint {
  // What the axis does, and its row.
  PfxUInt8 m_lock;
  PfxUInt8 m_warmStarting;          // start with the impulse of the step before
  PfxFloat m_movableLowerLimit;
  PfxFloat m_movableUpperLimit;
  PfxFloat m_bias;                  // 0 .. 1, share of the position error that a step takes back
  PfxFloat m_weight;                // 0 .. 1, scales the impulse; 0: no constraint
  PfxFloat m_damping;               // 0 .. 1, share of the velocity in the movable direction that a step takes away
  PfxFloat m_maxImpulse;            // N s, N m s
  PfxJointRow m_constraintRow;

  // Free, with bias 0.2, full weight, no damping and no limit of the impulse.
  PfxJointConstraint() { reset(); }
  void reset();
};

// Two bodies and the six axes between them.
struct PfxJoint {
  // Whether it takes part, its kind (ePfxJointType), the bodies, and the axes in the order translation, rotation.
  PfxUInt8 m_active = 1;
  PfxUInt8 m_numConstraints = 6;
  PfxUInt8 m_type = kPfxJointBall;
  PfxUInt16 m_rigidBodyIdA = 0;
  PfxUInt16 m_rigidBodyIdB = 0;
  PfxJointConstraint m_constraints[6];  // three translations, then twist about x and the swing about y and z
  PfxVector3 m_anchorA, m_anchorB;      // m, body frames
  PfxMatrix3 m_frameA, m_frameB;        // joint axes in the body frames
  double m_coupling[21] = {};           // 1/kg, of the rows on each other: filled by the solver
  void* m_userData = nullptr;
};

// Points and axes are given in the world. With enableJointFrame the columns of jointFrame are the joint's axes, and the
// axes below are ignored.
struct PfxJointInitParamBase {
  // Where the bodies meet (m, world), what all axes have of damping and bias (0 .. 1), and the axes when they are given directly.
  PfxVector3 anchorPoint = PfxVector3(0.0f);
  PfxFloat damping = 0.0f;
  PfxFloat bias = 0.2f;
  PfxMatrix3 jointFrame = PfxMatrix3::identity();
  PfxBool enableJointFrame = false;
};
struct PfxBallJointInitParam : PfxJointInitParamBase {};
struct PfxFixedJointInitParam : PfxJointInitParamBase {};
// The other name.
typedef PfxFixedJointInitParam PfxFixJointInitParam;
// Ranges in rad: twist about the axis, and swing of the axis away from where it stands.
struct PfxSwingTwistJointInitParam : PfxJointInitParamBase {
  // Twist axis (world) and ranges, rad.
  PfxVector3 twistAxis = PfxVector3(1.0f, 0.0f, 0.0f);
  PfxFloat twistLowerAngle = -0.2f * SCE_PFX_PI;
  PfxFloat twistUpperAngle = 0.2f * SCE_PFX_PI;
  PfxFloat swingLowerAngle = 0.0f;
  PfxFloat swingUpperAngle = 0.25f * SCE_PFX_PI;
};
// A lower limit above the upper one means: no limit.
struct PfxHingeJointInitParam : PfxJointInitParamBase {
  // Hinge axis (world) and range, rad.
  PfxVector3 axis = PfxVector3(1.0f, 0.0f, 0.0f);
  PfxFloat lowerAngle = 1.0f;
  PfxFloat upperAngle = -1.0f;
};
// A lower limit above the upper one means: no limit.
struct PfxSliderJointInitParam : PfxJointInitParamBase {
  // Direction of the way (world) and its range, m.
  PfxVector3 direction = PfxVector3(1.0f, 0.0f, 0.0f);
  PfxFloat lowerDistance = 1.0f;
  PfxFloat upperDistance = -1.0f;
};
// Two swing axes at right angles to `axis`; no twist.
struct PfxUniversalJointInitParam : PfxJointInitParamBase {
  // The axis that does not twist (world).
  PfxVector3 axis = PfxVector3(1.0f, 0.0f, 0.0f);
  PfxVector3 upVec = PfxVector3(0.0f, 1.0f, 0.0f);  // the first swing axis is as near to it as possible
  // Ranges of the two swings, rad.
  PfxFloat swing1LowerAngle = -0.7f;
  PfxFloat swing1UpperAngle = 0.7f;
  PfxFloat swing2LowerAngle = -0.7f;
  PfxFloat swing2UpperAngle = 0.7f;
};

// Make the joint anew between two bodies as they stand now. SCE_PFX_ERR_INVALID_VALUE: a value that is not finite, an axis
// without length, bias or damping outside of 0 .. 1; the joint is not changed then.
PfxInt32 pfxInitializeBallJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                const PfxBallJointInitParam& param);
PfxInt32 pfxInitializeSwingTwistJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                      const PfxSwingTwistJointInitParam& param);
PfxInt32 pfxInitializeHingeJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                 const PfxHingeJointInitParam& param);
PfxInt32 pfxInitializeSliderJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                  const PfxSliderJointInitParam& param);
PfxInt32 pfxInitializeFixedJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                 const PfxFixedJointInitParam& param);
inline PfxInt32 pfxInitializeFixJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                      const PfxFixedJointInitParam& param) {
  return pfxInitializeFixedJoint(joint, stateA, stateB, param);
}
PfxInt32 pfxInitializeUniversalJoint(PfxJoint& joint, const PfxRigidState& stateA, const PfxRigidState& stateB,
                                     const PfxUniversalJointInitParam& param);

// Bodies, motion types, active flag and joint id into the pair; to be called again when one of them changes.
PfxInt32 pfxUpdateJointPairs(PfxConstraintPair& pair, PfxUInt32 jointId, const PfxJoint& joint, const PfxRigidState& stateA,
                             const PfxRigidState& stateB);

}  // namespace PhysicsEffects
}  // namespace sce
