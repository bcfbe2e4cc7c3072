// Between joints and the rows of the soft solver: filling lanes before the solve, reading forces after it.
#pragma once

#include <span>

#include "pfx/base_level/constraint/joint_rows.h"
#include "pfx/base_level/math/vector_double.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/low_level/solver/joint_constraint.h"

namespace pfx {

// Whether the joint holds all three translations alike, so that the point part of a batch serves them.
bool hasPointPart(const Joint& joint);

// Rows for single axes that the joint needs beside the point part.
uint32_t numAxisRows(const Joint& joint);

// Where a joint's lane lies.
struct JointLane {
  JointBatch& batch;
  std::span<JointAxisRows> rows;  // of the batch
  int lane;
};

// What the solver body of one side offers. inv_mass is 0 on sides that the joint may not move.
struct JointSide {
  TransformDouble pose;
  double inv_mass;
  Mat3d inv_inertia;  // world axes
};

// Fills one lane of a batch that was cleared to zero. h: of a sub-step.
void fillJointLane(const Joint& joint, const JointSide& a, const JointSide& b, float h, bool warm_start,
                   const JointLane& to);

// Writes the forces of a lane to its joint. a: pose of body A at the start of the step.
void storeJointForces(const JointLane& from, const RigidState& a, float h, Joint& joint);

}  // namespace pfx
