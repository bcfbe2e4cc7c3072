// A body inside the direct joint solver: everything in double, so that forces of very different size cancel
// cleanly.
#pragma once

#include "pfx/base_level/math/vector_double.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/low_level/integrate/substep.h"

namespace pfx {

struct DirectBody {
  TransformDouble pose;
  TransformDouble next;                // where the current velocity leads
  Vec3d next_w = Vec3d::Zero();        // rad/s there
  Vec3d v = Vec3d::Zero();             // m/s
  Vec3d w = Vec3d::Zero();             // rad/s, world axes
  double inv_mass = 0.0;               // 1/kg; 0 for bodies that joints do not move
  Mat3d body_inertia = Mat3d::Zero();  // kg m^2, body axes
  Mat3d body_inverse = Mat3d::Zero();
  Mat3d inverse = Mat3d::Zero();    // 1/(kg m^2), world axes; what impulses see
  Mat3d stiffness = Mat3d::Zero();  // N m/rad, change of torque as the body turns under the joints' forces
  bool spherical = true;
  bool dynamic = false;
  Vec3d joint_velocity = Vec3d::Zero();  // m/s, that the joints have added in this sub-step, beside contacts
  Vec3d joint_momentum = Vec3d::Zero();  // N m s, world axes, likewise
  Vec3d acceleration = Vec3d::Zero();    // m/s^2
  Vec3d torque = Vec3d::Zero();          // N m
  double linear_decay = 1.0;             // of the velocity, a sub-step
  double angular_decay = 1.0;
};

DirectBody makeDirectBody(const RigidState& state, const RigidBody& body, const BodyMotion& motion);

// Velocity change of forces and damping over a part (0.5 or 1) of a sub-step of h seconds.
void kick(DirectBody& body, double h, double part);

// Sets next and next_w: free motion for h seconds, rotation in momentum form as in rotation_update.h.
void predict(DirectBody& body, double h);

// How fast the body vibrates under the forces of its joints, in units of what a sub-step resolves: h^2 |K| /
// I with the geometric stiffness K, `stiffness`.
double stiffnessRatio(const DirectBody& body, double h);

// Sets the inverse inertia for the current pose. stiffen: the inertia grows by h^2 |K|, column by column,
// which keeps light bodies between heavy ones stable where a sub-step cannot follow their vibration. Source:
// S. Andrews, M. Teichmann, P. Kry, Geometric Stiffness for Real-time Constrained Multibody Dynamics,
// Eurographics 2017; E. Tournier et al., Stable Constrained Dynamics, SIGGRAPH 2015.
void updateInverseInertia(DirectBody& body, double h, bool stiffen);

}  // namespace pfx
