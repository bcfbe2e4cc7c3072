// One manifold inside the island solver: its rows in double precision, their forces, and how those change.
//
// A row's impulse follows from its speed u by a stiff spring with damper (implicit, so that it gives way by
// very little and gains no energy): normal  f = max(0, base - (u + bias) / R),  friction  f = base - u / R,
// shortened to the circle of radius mu * normal impulse. `base` holds what the row carried before: friction
// starts from it, so that what sticks does not creep. Both are gradients of convex functions of the velocity,
// for a given radius. Source: E. Todorov, Convex and analytically-invertible dynamics with contacts and
// constraints, ICRA 2014; A. Castro et al., An Unconstrained Convex Formulation of Compliant Contact, IEEE
// T-RO 2023.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/math/vector_double.h"
#include "pfx/low_level/solver/contact_setup.h"

namespace pfx {

struct NewtonPoint {
  Vec3d arm[2];          // m, from the centres of mass of A and B, world axes, at the start of the step
  double turn[2][3][3];  // arm x axis, by side and row; rows are normal, tangent 1, tangent 2
  double separation;     // m, at the start of the step
  double stiffness[2];   // kg, 1 / R of normal and friction
  double bias;           // m/s, added to the normal speed
  double base[3];        // N s
  double impulse[3];     // N s
  double speed[3];       // m/s
  double change[3];      // m/s, of the speed along the search direction
  double radius;         // N s, of the circle of friction
  double curvature[4];   // kg; of the normal, of sliding friction and its direction, see setCurvature
  double approach;       // m/s, before the step
  double most_normal;    // N s, over the sub-steps
};

struct NewtonContact {
  ContactManifold* manifold;
  uint32_t body[2];  // local
  bool moves[2];
  bool round[2];
  uint32_t block;  // off-diagonal block of the pair, when both move
  bool a_is_row;   // A comes later in the order of elimination
  int num_points;
  double friction, restitution;
  Vec3d axis[3];  // normal from A to B, tangents
  NewtonPoint points[kMaxContactPoints];
};

// Speeds of the rows of a point at the velocities (linear, angular) of A and B.
inline void rowSpeeds(const NewtonContact& c, const NewtonPoint& p, const double* va, const double* vb,
                      double (&out)[3]) {
  for (int k = 0; k < 3; ++k) {
    const double linear =
        c.axis[k].x() * (vb[0] - va[0]) + c.axis[k].y() * (vb[1] - va[1]) + c.axis[k].z() * (vb[2] - va[2]);
    const double *ta = p.turn[0][k], *tb = p.turn[1][k];
    out[k] = linear + (tb[0] * vb[3] + tb[1] * vb[4] + tb[2] * vb[5]) -
             (ta[0] * va[3] + ta[1] * va[4] + ta[2] * va[5]);
  }
}

// Adds the impulses of a point to the momenta of A and B.
void addImpulse(const NewtonContact& c, const NewtonPoint& p, double sign, double* a, double* b);

// Impulses at the given speeds.
void impulsesAt(const NewtonPoint& p, const double (&speed)[3], double (&out)[3]);

// Notes how the impulses change with the speed. Returns whether that differs from before.
bool setCurvature(NewtonPoint& p);

// A row of the Jacobian.
struct NewtonJacobian {
  double a[6], b[6];
};

// Blocks (6 x 6, row by row) of A, of B, and of the pair. Null: not moved.
struct NewtonBlocks {
  double *a, *b, *pair;
};

// Adds weight * J^T J to the blocks.
void addRow(bool a_is_row, const NewtonBlocks& blocks, double weight, const NewtonJacobian& row);

// Adds J^T curvature J of all points.
void addCurvature(const NewtonContact& c, const NewtonBlocks& blocks);

}  // namespace pfx
