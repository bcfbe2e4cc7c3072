// Warm-started sequential impulses on velocities: the plain way of solving contacts and joints, one pair after the other.
// Joints are in impulse_joint.h.
//
// Rows are set up from the velocities at the start of the step; the iterations gather changes of velocity in the bodies.
// Position errors of joints enter as a velocity that takes back a share of them (Baumgarte). For contacts that velocity is
// solved apart and moves the bodies without staying in them: columns would gain energy from every overlap. Contacts have a
// circular friction cone. Source: E. Catto, Iterative Dynamics with Temporal Coherence, GDC 2005; Modeling and Solving
// Constraints, GDC 2009 (pseudo velocities).
#pragma once

#include "pfx/base_level/math/vector.h"

namespace pfx {

// Overlap up to here is taken back slowly: columns that rock find rest in it.
inline constexpr float kSoftOverlap = 0.003f;  // m

// What the solver keeps of a body. Inverse mass and inertia are zero for what does not give way.
struct ImpulseBody {
  float dv[3];            // m/s, change since the start of the step
  float inv_mass;         // 1/kg
  float dw[3];            // rad/s, world axes
  float pad;
  float inv_inertia[9];   // 1/(kg m^2), world axes
  float push_v[3];        // m/s, for the motion of this step alone: takes back overlap
  float push_w[3];        // rad/s
};

// A row along one direction at a point.
struct ImpulseRow {
  float normal[3];  // unit, world, from B to A
  float rhs;        // N s, impulse that would reach the wanted velocity from the start
  float inv_diag;   // kg, effective mass
  float lower, upper;
  float impulse;    // N s, gathered; the start of the next step
};

struct ImpulsePoint {
  float arm_a[3];  // m, world, from the centres of mass
  float arm_b[3];
  ImpulseRow rows[3];  // normal, two tangents
  float push_rhs;      // N s, as rhs, for the push along the normal
  float push[3];       // N s, gathered: normal, two tangents
};

// Two bodies that act on each other; one that a OneWay body meets is given as a copy without inverse mass.
struct ImpulsePair {
  ImpulseBody& a;
  ImpulseBody& b;
};

struct ImpulseContactInput {
  Vec3 arm_a, arm_b;     // m, world
  Vec3 velocity;         // m/s, of the point on A against that on B
  Vec3 normal;           // unit, from B to A
  float distance;        // m, negative: overlap
  float restitution;     // 0 .. 1
  float separate_bias;   // 0 .. 1, share of the overlap that a step takes back
  float time_step;       // s
};

// Sets up a point; the impulses in it are kept as the start, projected on the new tangents.
void setupImpulsePoint(const ImpulseContactInput& input, ImpulsePair pair, ImpulsePoint& point);

// Applies the impulses gathered in the step before.
void warmStart(ImpulsePair pair, const ImpulsePoint& point);

// One iteration.
void solveImpulses(ImpulsePair pair, float friction, ImpulsePoint& point);

// One iteration over the pushes. Friction, of the impulses and pushes together, keeps them from moving anything sideways.
void solvePush(ImpulsePair pair, float friction, ImpulsePoint& point);

}  // namespace pfx
