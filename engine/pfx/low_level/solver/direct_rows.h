// The rows of one joint inside the direct solver: what each axis asks for, and which rows take part.
//
// Rows are equations that the solve holds exactly; limits, motors and bounded forces are brought in and taken
// out between solves (active set), until no row pulls that may only push, none exceeds its bound, and no
// limit is passed.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/joint/joint_coordinates.h"
#include "pfx/low_level/solver/direct_body.h"

namespace pfx {

enum class RowState : uint8_t {
  Off,
  Fixed,  // coordinate = lower
  Lower,  // at the lower limit, pushes up only
  Upper,  // at the upper limit, pushes down only
  Drive,  // motor, spring or damper along the axis
};

struct DirectRow {
  uint8_t axis = 0;
  RowState state = RowState::Off;
  bool held = false;   // takes part in the solve
  int8_t clamped = 0;  // sign of the bound that the impulse stays at
  bool has_drive = false;
  double value = 0.0;             // coordinate at the current pose
  double next = 0.0;              // coordinate where the current velocities lead
  double goal = 0.0;              // coordinate to reach, of Fixed, Lower and Upper
  double drive_compliance = 0.0;  // speed that an impulse of one leaves over
  double drive_speed = 0.0;
  double drive_bound = 0.0;   // N s
  double bound = 0.0;         // N s, of Fixed, Lower and Upper
  double keep = 0.0;          // share of the position error that a sub-step leaves
  double softness = 0.0;      // (1 - weight) / weight
  double stiffness = 0.0;     // N/m, of the spring
  double damper = 0.0;        // N s/m
  double damping_rate = 0.0;  // 1/s, of a damper without spring
  double mobility = 0.0;      // 1/kg, along the axis with the fixed rows of the joint held
  double diagonal = 0.0;      // 1/kg, of the system
  double impulse = 0.0;       // N s, gathered in the current sub-step
};

struct DirectJoint {
  Joint* joint = nullptr;
  uint32_t body[2] = {0, 0};  // local indices
  bool moves[2] = {false, false};
  int num_rows = 0;
  DirectRow row[kNumJointAxes];
  double jacobian[2][kNumJointAxes][6];  // by side and row
  double response[2][kNumJointAxes][6];  // velocity change of the body by an impulse of one
  double length = 1.0;                   // m, what tolerances are measured by
  GearAngles turned = {0.0, 0.0};        // of a gear, at the current poses
  GearAngles expected = {0.0, 0.0};      // where the current velocities lead
  Vec3d impulse_sum = Vec3d::Zero();     // over the step, on B
  Vec3d torque_sum = Vec3d::Zero();
};

// How a sub-step is cut up.
struct DirectSubstep {
  double h;       // s, of the motion
  double part;    // share of h that forces act for: 1, or 0.5 at the ends of a leapfrog step
  bool leapfrog;  // velocities belong to the middle of the sub-step
  bool linear;    // positions at the end of the sub-step are taken from the Jacobian
};

// Chooses the rows of a joint, when its kind or locks have changed.
void chooseRows(DirectJoint& j);

// Once a step: what depends on the record and the bodies alone. substeps >= 1.
void beginRows(DirectJoint& j, std::span<const DirectBody> bodies, int substeps, bool warm_start);

// Jacobian, responses and goals at the current poses; the impulses of the rows stay.
void linearizeRows(DirectJoint& j, std::span<const DirectBody> bodies, const DirectSubstep& s);

// Recomputes `response` after the inverse inertias changed.
void updateResponses(DirectJoint& j, std::span<const DirectBody> bodies);

// Speed along a row, B against A.
double rowSpeed(const DirectJoint& j, int row, std::span<const DirectBody> bodies);

// Applies an impulse along a row.
void applyRow(const DirectJoint& j, int row, double impulse, std::span<DirectBody> bodies);

// Coordinates at the poses predicted for h seconds later.
void measureNext(DirectJoint& j, std::span<const DirectBody> bodies, double h);

// Brings rows in or takes them out. velocity_only: at the current pose instead of the predicted one. first:
// nothing is solved yet, rows only come in. Returns whether anything changed.
bool updateRows(DirectJoint& j, std::span<DirectBody> bodies, bool velocity_only, bool first);

// Adds to the stiffness of the bodies how the torque of the joint's forces changes as they turn.
void addStiffness(const DirectJoint& j, std::span<DirectBody> bodies);

// Adds the impulses of a sub-step to those of the step.
void sumImpulses(DirectJoint& j, std::span<const DirectBody> bodies);

// Writes what the joint reports of a step of dt seconds: its mean force and torque, and the angles of gears.
void reportForces(const DirectJoint& j, double dt);

// Speed that row `row` lacks, and as `tolerance` what of that counts as nothing.
struct RowResidual {
  double speed;
  double tolerance;
};
RowResidual rowResidual(const DirectJoint& j, int row, std::span<const DirectBody> bodies,
                        const DirectSubstep& s, bool velocity_only);

}  // namespace pfx
