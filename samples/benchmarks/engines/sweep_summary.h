// What a sweep says in numbers: order of convergence, plateau, cost of the target, performance profile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samples/benchmarks/engines/sweep.h"

namespace samples::benchmarks {

// Exponent p of error ~ substeps^-p, by least squares over the points above the case's floor; nothing when fewer than
// three are left.
std::optional<double> convergenceOrder(const SweepCurve& curve, double floor);

// Whether the error keeps falling: from 4 to n sub-steps by (n / 4)^(3/4) or more (by 8 for n = 64), or down to the
// floor. Nothing when the run with 4 sub-steps or a finer one is missing.
struct Plateau {
  bool passed;
  double coarse, fine;  // error at 4 and at `substeps`
  int substeps;
};
std::optional<Plateau> plateauTest(const SweepCurve& curve, double floor);

// ns per simulated second of the cheapest point whose error is at most `target`; infinite when there is none.
double costOfTarget(const SweepCurve& curve, double target);

// Performance profile: the share of cases that a solver brings below their target at no more than `ratio` times the
// cost of the best solver of each. Source: E. Dolan, J. More, Benchmarking optimization software with performance
// profiles, Math. Program. 91, 2002.
struct ProfileCurve {
  std::string solver;
  std::vector<double> ratios;  // ascending, one a case that it solves; the share is (index + 1) / cases
};
struct Profile {
  size_t cases = 0;
  std::vector<ProfileCurve> curves;
};
Profile performanceProfile(const std::vector<Sweep>& sweeps);

// Share of the cases at a ratio.
double shareAt(const Profile& profile, const ProfileCurve& curve, double ratio);

}  // namespace samples::benchmarks
