// Constraint solver and integration.
#pragma once

#include "contact.h"
#include "joint.h"

namespace sce {
namespace PhysicsEffects {

// Copy of what the solver needs of a body; of no use after pfxSolveConstraints().
struct PfxSolverBody {
  // Changes of velocity since the start of the step (m/s, rad/s, world axes), and what resists them (1/kg, 1/(kg m^2)).
  PfxFloat m_deltaLinearVelocity[3];
  PfxFloat m_massInv;
  PfxFloat m_deltaAngularVelocity[3];
  PfxFloat m_pad;
  PfxFloat m_inertiaInv[9];  // world axes
  PfxFloat m_pushLinearVelocity[3];   // for the motion of this step alone: takes back overlap
  PfxFloat m_pushAngularVelocity[3];
  PfxFloat m_orientation[4];
  PfxUInt32 m_motionType;
};

// Bodies, and their solver bodies to write.
struct PfxSetupSolverBodiesParam {
  union {
    PfxRigidState* states = nullptr;
    PfxRigidState* offsetRigidStates;
  };
  union {
    PfxRigidBody* bodies = nullptr;
    PfxRigidBody* offsetRigidBodies;
  };
  union {
    PfxSolverBody* solverBodies = nullptr;
    PfxSolverBody* offsetSolverBodies;
  };
  // In the arrays.
  SCE_PFX_NUM_RIGID_BODIES_;
};
// Pairs with contact ids, the arrays that the ids lead into, and the step (s).
struct PfxSetupContactConstraintsParam {
  // Arrays of the application.
  PfxConstraintPair* contactPairs = nullptr;
  PfxUInt32 numContactPairs = 0;
  PfxContactManifold* offsetContactManifolds = nullptr;
  PfxRigidState* offsetRigidStates = nullptr;
  PfxRigidBody* offsetRigidBodies = nullptr;
  PfxSolverBody* offsetSolverBodies = nullptr;
  SCE_PFX_NUM_RIGID_BODIES_;
  PfxFloat timeStep = 0.016f;
  PfxFloat separateBias = 0.2f;  // share of the overlap that a step takes back
};
// Pairs with joint ids, the arrays that the ids lead into, and the step (s).
struct PfxSetupJointConstraintsParam {
  // Arrays of the application.
  PfxConstraintPair* jointPairs = nullptr;
  PfxUInt32 numJointPairs = 0;
  PfxJoint* offsetJoints = nullptr;
  PfxRigidState* offsetRigidStates = nullptr;
  PfxRigidBody* offsetRigidBodies = nullptr;
  PfxSolverBody* offsetSolverBodies = nullptr;
  SCE_PFX_NUM_RIGID_BODIES_;
  PfxFloat timeStep = 0.016f;
};
// Pairs of contacts and joints that were set up, and how often to visit them.
struct PfxSolveConstraintsParam {
  // Scratch, aligned to 16 bytes; arrays of the application; iterations, at least 1.
  void* workBuff = nullptr;
  PfxUInt32 workBytes = 0;
  PfxConstraintPair* contactPairs = nullptr;
  PfxUInt32 numContactPairs = 0;
  PfxContactManifold* offsetContactManifolds = nullptr;
  PfxConstraintPair* jointPairs = nullptr;
  PfxUInt32 numJointPairs = 0;
  PfxJoint* offsetJoints = nullptr;
  PfxRigidState* offsetRigidStates = nullptr;
  PfxSolverBody* offsetSolverBodies = nullptr;
  SCE_PFX_NUM_RIGID_BODIES_;
  PfxUInt32 iteration = 5;
};
// Bodies to move, and the step (s).
struct PfxUpdateRigidStatesParam {
  union {
    PfxRigidState* states = nullptr;
    PfxRigidState* offsetRigidStates;
  };
  union {
    PfxRigidBody* bodies = nullptr;
    PfxRigidBody* offsetRigidBodies;
  };
  // In the arrays.
  SCE_PFX_NUM_RIGID_BODIES_;
  PfxFloat timeStep = 0.016f;  // s
};

// All return SCE_PFX_ERR_INVALID_VALUE for NULL, bad numbers and a time step that is not positive, and
// SCE_PFX_ERR_OUT_OF_RANGE when a pair names a body that is not there.
PfxInt32 pfxSetupSolverBodies(PfxSetupSolverBodiesParam& param, PfxTaskManager* taskManager = nullptr);
PfxInt32 pfxSetupContactConstraints(PfxSetupContactConstraintsParam& param, PfxTaskManager* taskManager = nullptr);
PfxInt32 pfxSetupJointConstraints(PfxSetupJointConstraintsParam& param, PfxTaskManager* taskManager = nullptr);
// Bytes of scratch for so many bodies and pairs, whatever the number of tasks.
PfxUInt32 pfxGetWorkBytesOfSolveConstraints(PfxUInt32 numRigidBodies, PfxUInt32 numContactPairs, PfxUInt32 numJointPairs,
                                            PfxUInt32 maxTasks = 1);
// Changes velocities only. SCE_PFX_ERR_OUT_OF_BUFFER, SCE_PFX_ERR_INVALID_ALIGN: the work buffer.
PfxInt32 pfxSolveConstraints(PfxSolveConstraintsParam& param, PfxTaskManager* taskManager = nullptr);
// Moves one body by its velocities; the stage below does so for all.
PfxInt32 pfxIntegrate(PfxRigidState& state, const PfxRigidBody& body, PfxFloat timeStep);
// Moves all bodies by their velocities.
PfxInt32 pfxUpdateRigidStates(PfxUpdateRigidStatesParam& param, PfxTaskManager* taskManager = nullptr);

}  // namespace PhysicsEffects
}  // namespace sce
