// Chapters 2, 3 and 10: the six kinds of joints with every parameter, and the axes of one changed at run time.
#include <cmath>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

static PfxRigidState states[2];
static PfxRigidBody bodies[2];
static PfxSolverBody solverBodies[2];
static PfxJoint joint;
static PfxConstraintPair jointPair;
alignas(16) static char workBuff[4096];

static void place() {
  for (PfxUInt16 i = 0; i < 2; i++) {
    bodies[i].reset();
    bodies[i].setMass(5.0f);
    bodies[i].setInertia(pfxCalcInertiaBox(PfxVector3(0.25f, 0.7f, 1.0f), 5.0f));
    states[i].reset();
    states[i].setRigidBodyId(i);
    states[i].setPosition(PfxVector3(0.0f, -1.5f * i, 0.0f));
    states[i].setMotionType(i == 0 ? kPfxMotionTypeFixed : kPfxMotionTypeActive);
    states[i].setAngularDamping(1.0f);
  }
}

static void simulate(int frames, const PfxVector3& force, const PfxVector3& torque) {
  const PfxFloat timeStep = 1.0f / 60.0f;
  for (int frame = 0; frame < frames; frame++) {
    pfxApplyExternalForce(states[1], bodies[1], force, torque, timeStep);
    PfxSetupSolverBodiesParam setup;
    setup.states = states;
    setup.bodies = bodies;
    setup.solverBodies = solverBodies;
    setup.numRigidBodies = 2;
    CHECK(pfxSetupSolverBodies(setup) == SCE_PFX_OK);
    CHECK(pfxUpdateJointPairs(jointPair, 0, joint, states[0], states[1]) == SCE_PFX_OK);
    PfxSetupJointConstraintsParam jointParam;
    jointParam.jointPairs = &jointPair;
    jointParam.numJointPairs = 1;
    jointParam.offsetJoints = &joint;
    jointParam.offsetRigidStates = states;
    jointParam.offsetRigidBodies = bodies;
    jointParam.offsetSolverBodies = solverBodies;
    jointParam.numRigidBodies = 2;
    jointParam.timeStep = timeStep;
    CHECK(pfxSetupJointConstraints(jointParam) == SCE_PFX_OK);
    PfxSolveConstraintsParam solve;
    solve.workBuff = workBuff;
    solve.workBytes = pfxGetWorkBytesOfSolveConstraints(2, 0, 1);
    solve.contactPairs = NULL;
    solve.numContactPairs = 0;
    solve.offsetContactManifolds = NULL;
    solve.jointPairs = &jointPair;
    solve.numJointPairs = 1;
    solve.offsetJoints = &joint;
    solve.offsetRigidStates = states;
    solve.offsetSolverBodies = solverBodies;
    solve.numRigidBodies = 2;
    solve.iteration = 5;
    CHECK(pfxSolveConstraints(solve) == SCE_PFX_OK);
    PfxUpdateRigidStatesParam update;
    update.states = states;
    update.bodies = bodies;
    update.numRigidBodies = 2;
    update.timeStep = timeStep;
    CHECK(pfxUpdateRigidStates(update) == SCE_PFX_OK);
  }
}

static PfxFloat angle() { return 2.0f * std::acos(SCE_PFX_MIN(1.0f, std::fabs(states[1].getOrientation()[3]))); }
static PfxVector3 anchorError(const PfxVector3& anchor) {
  return states[1].getPosition() + rotate(states[1].getOrientation(), anchor - PfxVector3(0.0f, -1.5f, 0.0f)) - anchor;
}

int main() {
  const PfxVector3 anchor(0.0f, -0.75f, 0.0f);

  place();
  PfxBallJointInitParam ball;
  ball.anchorPoint = anchor;
  CHECK(pfxInitializeBallJoint(joint, states[0], states[1], ball) == SCE_PFX_OK);
  simulate(30, PfxVector3(3.0f, 0.0f, 2.0f), PfxVector3(0.0f));
  CHECK(length(anchorError(anchor)) < 1e-3f);
  CHECK(angle() > 0.05f);

  place();
  PfxSwingTwistJointInitParam swing;
  swing.anchorPoint = anchor;
  swing.twistAxis = PfxVector3(0.0f, 1.0f, 0.0f);
  swing.twistLowerAngle = -0.3f;
  swing.twistUpperAngle = 0.3f;
  swing.swingLowerAngle = 0.0f;
  swing.swingUpperAngle = 0.4f;
  CHECK(pfxInitializeSwingTwistJoint(joint, states[0], states[1], swing) == SCE_PFX_OK);
  simulate(200, PfxVector3(20.0f, 0.0f, 15.0f), PfxVector3(0.0f));
  CHECK(length(anchorError(anchor)) < 1e-3f);
  CHECK(angle() > 0.35f && angle() < 0.4f + 0.02f);
  place();
  CHECK(pfxInitializeSwingTwistJoint(joint, states[0], states[1], swing) == SCE_PFX_OK);
  simulate(200, PfxVector3(0.0f), PfxVector3(0.0f, 5.0f, 0.0f));
  CHECK(std::fabs(angle() - 0.3f) < 0.02f);

  place();
  PfxHingeJointInitParam hinge;
  hinge.anchorPoint = anchor;
  hinge.axis = PfxVector3(1.0f, 0.0f, 0.0f);
  hinge.lowerAngle = -0.5f;
  hinge.upperAngle = 0.7f;
  CHECK(pfxInitializeHingeJoint(joint, states[0], states[1], hinge) == SCE_PFX_OK);
  simulate(200, PfxVector3(0.0f), PfxVector3(20.0f, 3.0f, 3.0f));
  CHECK(std::fabs(angle() - 0.7f) < 0.02f);
  simulate(200, PfxVector3(0.0f), PfxVector3(-20.0f, 3.0f, 3.0f));
  CHECK(std::fabs(angle() - 0.5f) < 0.02f);
  CHECK(std::fabs(states[1].getOrientation()[1]) < 1e-3f);

  // Lock, range and freedom of a single axis, while it runs.
  joint.m_constraints[3].m_lock = SCE_PFX_JOINT_LOCK_FREE;
  simulate(60, PfxVector3(0.0f), PfxVector3(-20.0f, 0.0f, 0.0f));
  CHECK(angle() > 0.6f);
  place();
  CHECK(pfxInitializeHingeJoint(joint, states[0], states[1], hinge) == SCE_PFX_OK);
  joint.m_constraints[3].m_lock = SCE_PFX_JOINT_LOCK_FIX;
  simulate(60, PfxVector3(0.0f), PfxVector3(20.0f, 0.0f, 0.0f));
  CHECK(angle() < 1e-3f);

  place();
  PfxSliderJointInitParam slider;
  slider.anchorPoint = anchor;
  slider.direction = PfxVector3(0.0f, 0.0f, 1.0f);
  slider.lowerDistance = 0.0f;
  slider.upperDistance = 1.0f;
  CHECK(pfxInitializeSliderJoint(joint, states[0], states[1], slider) == SCE_PFX_OK);
  simulate(200, PfxVector3(5.0f, 5.0f, 20.0f), PfxVector3(2.0f, 2.0f, 2.0f));
  CHECK(length(states[1].getPosition() - PfxVector3(0.0f, -1.5f, 1.0f)) < 0.005f);
  CHECK(angle() < 1e-3f);

  place();
  PfxFixJointInitParam fix;
  fix.anchorPoint = anchor;
  fix.bias = 0.6f;
  CHECK(pfxInitializeFixJoint(joint, states[0], states[1], fix) == SCE_PFX_OK);
  simulate(60, PfxVector3(50.0f), PfxVector3(20.0f));
  CHECK(length(states[1].getPosition() - PfxVector3(0.0f, -1.5f, 0.0f)) < 1e-3f);

  place();
  PfxUniversalJointInitParam universal;
  universal.anchorPoint = anchor;
  universal.axis = PfxVector3(0.0f, 0.0f, 1.0f);
  universal.upVec = PfxVector3(0.0f, 1.0f, 0.0f);
  universal.swing1LowerAngle = -0.5f;
  universal.swing1UpperAngle = 0.5f;
  universal.swing2LowerAngle = -0.2f;
  universal.swing2UpperAngle = 0.2f;
  CHECK(pfxInitializeUniversalJoint(joint, states[0], states[1], universal) == SCE_PFX_OK);
  simulate(200, PfxVector3(0.0f), PfxVector3(0.0f, 30.0f, 0.0f));
  CHECK(std::fabs(angle() - 0.5f) < 0.02f);
  place();
  universal.upVec = PfxVector3(1.0f, 0.0f, 0.0f);
  CHECK(pfxInitializeUniversalJoint(joint, states[0], states[1], universal) == SCE_PFX_OK);
  simulate(200, PfxVector3(0.0f), PfxVector3(0.0f, 30.0f, 0.0f));
  CHECK(std::fabs(angle() - 0.2f) < 0.02f);

  // A joint frame takes the place of the axes, and a damped hinge stops.
  place();
  hinge.enableJointFrame = true;
  hinge.jointFrame = PfxMatrix3(PfxVector3(0.0f, 0.0f, 1.0f), PfxVector3(1.0f, 0.0f, 0.0f), PfxVector3(0.0f, 1.0f, 0.0f));
  hinge.damping = 0.1f;
  CHECK(pfxInitializeHingeJoint(joint, states[0], states[1], hinge) == SCE_PFX_OK);
  simulate(20, PfxVector3(10.0f, 0.0f, 10.0f), PfxVector3(0.0f));
  CHECK(states[1].getPosition()[0] > 1e-3f);
  CHECK(std::fabs(states[1].getPosition()[2]) < 1e-3f);
  simulate(60, PfxVector3(0.0f), PfxVector3(0.0f));
  CHECK(length(states[1].getAngularVelocity()) < 1e-3f);

  // A joint that is not active holds nothing.
  place();
  CHECK(pfxInitializeBallJoint(joint, states[0], states[1], ball) == SCE_PFX_OK);
  joint.m_active = false;
  simulate(60, PfxVector3(5.0f, 0.0f, 0.0f), PfxVector3(0.0f));
  CHECK(std::fabs(states[1].getPosition()[0] - 0.5f * 60.0f * 61.0f / 3600.0f) < 1e-3f);
  return failures == 0 ? 0 : 1;
}
