// Classical fourth-order Runge-Kutta in double precision, for the answers of the accuracy cases.
#pragma once

namespace samples::accuracy {

// y after `steps` steps of dt / steps. State: an Eigen vector or matrix; rate(y) gives y'.
template <class State, class Rate>
State rungeKutta(State y, double dt, int steps, const Rate& rate) {
  const double h = dt / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = rate(y);
    const State k2 = rate(State(y + 0.5 * h * k1));
    const State k3 = rate(State(y + 0.5 * h * k2));
    const State k4 = rate(State(y + h * k3));
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return y;
}

}  // namespace samples::accuracy
