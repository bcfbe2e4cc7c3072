#include "samples/benchmarks/engines/sweep_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/base_level/math/trig.h"

namespace samples::benchmarks {

std::optional<double> convergenceOrder(const SweepCurve& curve, double floor) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const SweepPoint& p : curve.points) {
    const double error = std::abs(p.error);
    if (!std::isfinite(error) || error <= floor) continue;
    const double x = pfx::log(double(p.substeps)), y = pfx::log(error);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  if (n < 3) return std::nullopt;
  return -(n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::optional<Plateau> plateauTest(const SweepCurve& curve, double floor) {
  const auto coarse = std::ranges::find(curve.points, 4, &SweepPoint::substeps);
  if (coarse == curve.points.end() || curve.points.back().substeps <= 4) return std::nullopt;
  const SweepPoint& fine = curve.points.back();
  const double factor = pfx::pow(fine.substeps / 4.0, 0.75);
  const double limit = std::max(floor, std::abs(coarse->error) / factor);
  return Plateau{std::abs(fine.error) <= limit, coarse->error, fine.error, fine.substeps};
}

double costOfTarget(const SweepCurve& curve, double target) {
  double best = std::numeric_limits<double>::infinity();
  for (const SweepPoint& p : curve.points)
    if (std::abs(p.error) <= target) best = std::min(best, p.ns_per_second);
  return best;
}

Profile performanceProfile(const std::vector<Sweep>& sweeps) {
  Profile profile{.cases = sweeps.size(), .curves = {}};
  const auto curveOf = [&](const std::string& solver) -> ProfileCurve& {
    const auto found = std::ranges::find(profile.curves, solver, &ProfileCurve::solver);
    if (found != profile.curves.end()) return *found;
    return profile.curves.emplace_back(ProfileCurve{solver, {}});
  };
  for (const Sweep& sweep : sweeps) {
    const double target = sweep.accuracy_case->target;
    double best = std::numeric_limits<double>::infinity();
    for (const SweepCurve& c : sweep.curves) best = std::min(best, costOfTarget(c, target));
    for (const SweepCurve& c : sweep.curves) {
      ProfileCurve& curve = curveOf(c.solver);
      const double cost = costOfTarget(c, target);
      if (std::isfinite(cost)) curve.ratios.push_back(cost / best);
    }
  }
  for (ProfileCurve& c : profile.curves) std::ranges::sort(c.ratios);
  return profile;
}

double shareAt(const Profile& profile, const ProfileCurve& curve, double ratio) {
  const auto solved = std::ranges::upper_bound(curve.ratios, ratio) - curve.ratios.begin();
  return double(solved) / double(std::max<size_t>(1, profile.cases));
}

}  // namespace samples::benchmarks
