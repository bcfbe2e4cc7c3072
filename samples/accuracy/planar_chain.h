// A chain of equal rods that swings in a plane, with a ball welded to its end, in minimal coordinates.
//
// The angles t_i of the rods from hanging are independent, and with a_ij, b_i from masses and lengths
//   sum_j a_ij (cos(t_i - t_j) t_j'' + sin(t_i - t_j) t_j'^2) + g b_i sin(t_i) = 0.
// Source: Lagrange's equations; a_ij is what rods i and j carry between them, b_i what rod i carries.
#pragma once

#include "pfx/base_level/math/vector_double.h"

namespace samples::accuracy {

struct ChainShape {
  int links = 1;
  double length = 1.0;       // m, of a rod
  double width = 0.1;        // m
  double mass = 1.0;         // kg, of a rod
  double ball_mass = 0.0;    // kg
  double ball_radius = 0.0;  // m
};

class PlanarChain {
 public:
  PlanarChain(const ChainShape& shape, double angle);  // all rods at this angle, at rest

  void advance(double dt, int steps);
  double angle(int link) const { return state_[link]; }
  pfx::Vec3d joint(int link) const;  // m, upper end of the rod; joint(links) is the end of the chain
  pfx::Vec3d middle(int link) const { return 0.5 * (joint(link) + joint(link + 1)); }

 private:
  Eigen::VectorXd rate(const Eigen::VectorXd& state) const;

  ChainShape shape_;
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;      // kg m
  Eigen::VectorXd state_;  // angles, then their rates
};

}  // namespace samples::accuracy
