#include "samples/accuracy/planar_chain.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "pfx/base_level/math/trig.h"
#include "samples/accuracy/case.h"
#include "samples/accuracy/integrate.h"

namespace samples::accuracy {

PlanarChain::PlanarChain(const ChainShape& shape, double angle) : shape_(shape) {
  const int n = shape.links;
  const double l = shape.length, m = shape.mass;
  a_.resize(n, n);
  b_.resize(n);
  for (int i = 0; i < n; ++i) {
    const double below = m * (n - 1 - i) + shape.ball_mass;  // kg, hanging from the end of rod i
    b_[i] = l * (below + 0.5 * m);
    for (int j = 0; j < i; ++j) a_(i, j) = a_(j, i) = l * l * (below + 0.5 * m);
    a_(i, i) = l * l * (below + 0.25 * m) + m * (l * l + shape.width * shape.width) / 12.0;
  }
  a_(n - 1, n - 1) += 0.4 * shape.ball_mass * shape.ball_radius * shape.ball_radius;
  state_ = Eigen::VectorXd::Zero(2 * n);
  state_.head(n).setConstant(angle);
}

Eigen::VectorXd PlanarChain::rate(const Eigen::VectorXd& state) const {
  const int n = shape_.links;
  Eigen::VectorXd s(n), c(n), force(n);
  for (int i = 0; i < n; ++i) {
    const pfx::SinCosDouble t = pfx::sincos(state[i]);
    s[i] = t.sin, c[i] = t.cos;
  }
  Eigen::MatrixXd mass(n, n);
  for (int i = 0; i < n; ++i) {
    force[i] = -double(kGravity) * b_[i] * s[i];
    for (int j = 0; j < n; ++j) {
      mass(i, j) = a_(i, j) * (c[i] * c[j] + s[i] * s[j]);
      force[i] -= a_(i, j) * (s[i] * c[j] - c[i] * s[j]) * state[n + j] * state[n + j];
    }
  }
  Eigen::VectorXd out(2 * n);
  out << state.tail(n), mass.llt().solve(force);
  return out;
}

void PlanarChain::advance(double dt, int steps) {
  state_ = rungeKutta(state_, dt, steps, [this](const Eigen::VectorXd& s) { return rate(s); });
}

pfx::Vec3d PlanarChain::joint(int link) const {
  pfx::Vec3d p = pfx::Vec3d::Zero();
  for (int i = 0; i < link; ++i) {
    const pfx::SinCosDouble t = pfx::sincos(state_[i]);
    p += shape_.length * pfx::Vec3d(t.sin, -t.cos, 0.0);
  }
  return p;
}

}  // namespace samples::accuracy
