// Contact constraints of eight manifolds side by side, as the solver's kernels read them.
//
// Lanes of one batch share no dynamic body (graph colouring), so that they can be solved at once. Idle lanes
// have zero masses and point at no body; they stay neutral.
#pragma once

#include <cstdint>

#include "pfx/base_level/constraint/softness.h"

namespace pfx {

inline constexpr int kRowLanes = 8;

using Lane = float[kRowLanes];

// The set-up copies from a manifold; the kernel `prepare` turns that into the row. Where the two differ, the
// first meaning stands in brackets.
struct alignas(32) ContactPointRows {
  Lane arm_a[3];  // m, contact point - centre of mass of A, world axes, at the start of the step [body axes]
  Lane arm_b[3];
  Lane separation;       // m, at the start of the step
  Lane normal_mass;      // kg [1 where the point exists, else 0]
  Lane tangent_mass[3];  // kg; inverse of the 2 x 2 tangent block: 11, 12, 22 [remembered friction, world
                         // axes, N s]
  Lane normal_impulse;   // N s
  Lane tangent_impulse[2];
  Lane max_normal_impulse;  // N s, over the sub-steps; restitution acts where it is positive
  Lane approach_speed;      // m/s, normal velocity before the step; negative: approaching
};

// Resistance to turning, of the batches that have any: a torque about the normal, and one across it.
struct alignas(32) RollingRows {
  Lane rolling;     // m, most torque across the normal for each newton of normal force
  Lane torsional;   // m, the same about the normal
  Lane mass;        // kg m^2, of the turn about any axis
  Lane impulse[3];  // N m s, on B, world axes, over the sub-step
};

struct alignas(32) ContactRows {
  RollingRows* rolling;       // null in most batches
  int32_t body_a[kRowLanes];  // index of the solver body; the last one is a dummy at rest
  int32_t body_b[kRowLanes];
  uint32_t writable_a;  // bit i: lane i may change its body A
  uint32_t writable_b;
  uint32_t num_points;       // the most of any lane, 1 .. 4; missing points have zero mass
  uint32_t has_restitution;  // 0 or 1: some lane bounces
  uint32_t is_new;           // bit i: nothing is known of the impulses of lane i
  uint32_t bounces_in_order;  // bit i: impacts of lane i are events within the step; else they count at its end
  uint32_t has_bounced;       // 0 or 1: some lane did when impacts were last looked for
  alignas(32) Lane normal[3];  // unit, from A to B
  Lane tangent[3];           // unit; the second tangent is normal x tangent
  Lane center_a[3];          // m, mean of the arms: friction acts at center + friction_spread * (arm - center)
  Lane center_b[3];
  // 1: the contact point turns with the body; 0: it stays below, as on a ball that rolls.
  Lane turns_a;
  Lane turns_b;
  Lane friction;
  Lane friction_spread;  // share of the distance between a point and the centre at which its friction acts
  Lane restitution;
  Lane fall;  // m/s^2, acceleration of B against A along the normal, of lanes that bounce in order
  Lane bias_rate;
  Lane mass_scale;
  Lane impulse_scale;
  ContactPointRows points[4];
};

// Numbers that are the same for every row of a step.
struct ContactSolveParams {
  float inv_h;            // 1/s, of the sub-step
  Softness moving;        // of a contact between two bodies that move
  Softness fixed;         // of a contact with something that does not give way
  float max_push_speed;   // m/s at which overlap is resolved at most
  float restitution_threshold;  // m/s: slower impacts do not bounce
};

}  // namespace pfx
