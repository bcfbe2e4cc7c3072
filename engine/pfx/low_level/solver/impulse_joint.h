// Joints in sequential impulses: the six rows of a joint are solved together, the joints one after the other.
//
// Row by row, a body that is much thinner than its lever is long takes hundreds of iterations to settle between the rows
// that hold its anchor and those that hold its rotation. Together they take one.
#pragma once

#include "pfx/base_level/joint/joint_coordinates.h"
#include "pfx/low_level/solver/sequential_impulse.h"

namespace pfx {

// A row of a joint.
struct ImpulseJointRow {
  float jacobian[12];  // (vA, wA, vB, wB)
  float rhs;           // N s, impulse that would reach the wanted rate from the start if the row were alone
  float inv_diag;      // kg, effective mass of the row alone
  float lower, upper;  // N s
  float impulse;       // N s, gathered; the start of the next step
  float weight;        // 0 .. 1, share of each change of the impulse that is applied
  float softness;      // 1/kg, rate that the row leaves per impulse that it applies: damping
};

inline constexpr int kNumImpulseCouplings = kNumJointAxes * (kNumJointAxes + 1) / 2;

// The rows of a joint, and the rate that a unit impulse of one gives another: the lower triangle of J M^-1 J^T, by rows.
struct ImpulseJoint {
  ImpulseJointRow* row[kNumJointAxes];
  double* coupling;  // (21) 1/kg
};

struct ImpulseJointInput {
  const AxisConstraint& axis;  // lock, range, bias, damping, weight; max_force is an impulse in N s here
  double value;                // of the axis, m or rad
  const double* jacobian_a;    // (6)
  const double* jacobian_b;    // (6)
  float rate;                  // of the value at the start of the step, m/s or rad/s
  float time_step;             // s
  bool warm_start;
};

// Sets up one row; its impulse is kept as the start where the axis says so.
void setupImpulseJointRow(const ImpulseJointInput& input, ImpulsePair pair, ImpulseJointRow& row);

// Fills `coupling`, and the softness of damped rows, when all six rows are set up.
void coupleImpulseRows(ImpulsePair pair, const ImpulseJoint& joint);

// Applies the impulses gathered in the step before.
void warmStart(ImpulsePair pair, const ImpulseJoint& joint);

// One iteration: the impulses with which every row reaches its rate, or rests at a limit that keeps it from it.
void solveImpulses(ImpulsePair pair, const ImpulseJoint& joint);

}  // namespace pfx
