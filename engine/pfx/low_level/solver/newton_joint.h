// One joint inside the island solver: its rows as stiff springs beside those of contacts.
//
// impulse = base - k (u + bias), kept between two bounds: an equation pulls and pushes, a limit only pushes,
// a motor has a strength. That is the gradient of a convex function of the speed u, like the rows of contacts
// (newton_contact.h), so that Newton's method holds both at once. A row gives way by its impulse / k, and
// `base`, what it carried before, takes even that away.
#pragma once

#include <span>

#include "pfx/low_level/solver/direct_rows.h"
#include "pfx/low_level/solver/joint_constraint.h"
#include "pfx/low_level/solver/newton_contact.h"

namespace pfx {

struct NewtonRow {
  int axis_row;             // of the joint
  NewtonJacobian jacobian;  // speed is that of B against A
  double stiffness;         // kg or kg m^2
  double bias;              // m/s or rad/s
  double base;              // N s or N m s
  double least, most;       // of the impulse
  double impulse;
  double speed, change;  // now, and along the search direction
  double curvature;      // stiffness, or 0 at a bound
};

struct NewtonJoint {
  DirectJoint joint;
  uint32_t block;  // off-diagonal block of the pair, when both move
  bool a_is_row;   // A comes later in the order of elimination
  int num_rows;
  NewtonRow row[2 * kNumJointAxes];  // of an axis with limits and a drive: two
};

NewtonJoint makeNewtonJoint(const JointConstraint& constraint, const uint32_t (&body)[2]);

// Once a step.
void begin(NewtonJoint& joint, std::span<const DirectBody> bodies, double h, int substeps);

// N that its motors may press with, after begin.
double strengthOf(const NewtonJoint& joint);

// Rows at the poses of the bodies, starting from the impulses of the last sub-step. push: errors of the
// position are taken back in this sub-step; else only what opens further is held.
void linearize(NewtonJoint& joint, std::span<const DirectBody> bodies, double h, bool push);

// Speeds and impulses of the rows at the velocities (linear, angular) of A and B.
void evaluate(NewtonJoint& joint, const double* va, const double* vb);

// Speeds of the rows along a search direction.
void setChange(NewtonJoint& joint, const double* da, const double* db);

// Of the objective, along the search direction.
double slopeAt(const NewtonJoint& joint, double step);

// Notes which rows are at a bound. Returns whether that differs from before.
bool setCurvature(NewtonJoint& joint);

void addCurvature(const NewtonJoint& joint, const NewtonBlocks& blocks);

// Adds the impulses to the momenta of A and B.
void addImpulses(const NewtonJoint& joint, double sign, double* a, double* b);

// The joint remembers its impulses as forces, over a sub-step of h seconds.
void rememberForces(NewtonJoint& joint, double h);

// The joint remembers nothing: whoever solves it next starts from no guess.
void forget(NewtonJoint& joint);

}  // namespace pfx
