// The figures by which a run is judged: conserved quantities, errors and counts of a world.
#pragma once

#include "pfx/high_level/world/world.h"

namespace viewer {

struct Figures {
  double kinetic_energy = 0.0;                                 // J, of all bodies that the solver moves
  double potential_energy = 0.0;                               // J, zero at the origin
  Eigen::Vector3d linear_momentum = Eigen::Vector3d::Zero();   // kg m/s
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  // kg m^2/s, about the origin
  double max_penetration = 0.0;  // m, deepest overlap that the last detection saw, >= 0
  double max_joint_error = 0.0;  // m, widest gap of a joint
  double max_speed = 0.0;        // m/s, fastest centre of mass
  pfx::WorldCounts counts;
};

Figures computeFigures(const pfx::World& world);

}  // namespace viewer
