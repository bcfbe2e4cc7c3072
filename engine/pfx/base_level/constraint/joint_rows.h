// Joint constraints of eight joints side by side, as the kernels of the soft solver read them.
//
// A batch has a point part, for joints that hold all three translations (it follows the rotation of its
// levers from pass to pass), and rows for single axes, linear in the motion since the start of the step.
// Lanes of one batch share no dynamic body; idle lanes have zero weight and stay neutral.
#pragma once

#include <cstdint>

#include "pfx/base_level/constraint/contact_rows.h"
#include "pfx/base_level/constraint/softness.h"

namespace pfx {

struct alignas(32) JointAxisRows {
  Lane linear[3];  // on B; A has the opposite. World axes.
  Lane angular_a[3];
  Lane angular_b[3];
  Lane value;  // m or rad, at the start of the step
  Lane lower;  // allowed range of the value; both equal for a fixed axis. Unused by drives.
  Lane upper;
  Lane bias;          // 0 .. 1
  Lane mass;          // kg or kg m^2, times weight; 0 in idle lanes
  Lane is_drive;      // 1 for motors, springs and dampers, else 0
  Lane target_speed;  // m/s or rad/s, of a drive
  Lane compliance;    // 1/kg, of a drive
  Lane max_impulse;   // N s
  Lane impulse;       // N s, over the sub-step
};

struct alignas(32) JointBatch {
  int32_t body_a[kRowLanes];  // index of the solver body; the last one is a dummy at rest
  int32_t body_b[kRowLanes];
  uint32_t writable_a;  // bit i: lane i may change its body A
  uint32_t writable_b;
  uint32_t first_row;         // rows of single axes: index into their array
  uint32_t num_rows;          // the most of any lane
  uint32_t has_point;         // 0 or 1: some lane has a point part
  alignas(32) Lane arm_a[3];  // m, from the centre of mass, world axes at the start of the step
  Lane arm_b[3];
  Lane separation[3];      // m, anchor B - anchor A at the start of the step
  Lane point_weight;       // 0 .. 1; 0: no point part
  Lane point_bias;         // 0 .. 1
  Lane max_point_impulse;  // N s
  Lane point_impulse[3];   // N s, on B, world axes, over the sub-step
  Lane lever_a[3];         // m, the arms that the impulse last acted at
  Lane lever_b[3];
};

// Numbers that are the same for every joint of a step.
struct JointSolveParams {
  Softness softness;
  float inv_h;  // 1/s, of the sub-step
};

}  // namespace pfx
