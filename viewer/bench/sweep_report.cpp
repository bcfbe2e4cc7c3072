#include "viewer/bench/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/bench/diagram.h"

namespace viewer {
namespace {

namespace bench = samples::benchmarks;
using nlohmann::ordered_json;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, pattern, values...);
  return buffer;
}

std::string inUnit(std::string_view unit) { return unit.empty() ? "relative" : std::string(unit); }

// Infinite numbers are null in JSON.
ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

std::string costText(double ns_per_second) {
  return std::isfinite(ns_per_second) ? format("%.3g us/s", 1e-3 * ns_per_second) : "never";
}

std::string summaryLine(const bench::SweepCurve& curve, const samples::accuracy::Case& c) {
  std::string line = "    cost of the target " + costText(bench::costOfTarget(curve, c.target));
  if (!c.smooth) return line + "\n";
  if (const auto order = bench::convergenceOrder(curve, c.floor)) line += format(", order %.1f", *order);
  if (const auto plateau = bench::plateauTest(curve, c.floor))
    line += format(", plateau test %s (%.2e at 4, %.2e at %d sub-steps)", plateau->passed ? "passed" : "FAILED",
                   plateau->coarse, plateau->fine, plateau->substeps);
  return line + "\n";
}

}  // namespace

std::string sweepText(const bench::Sweep& sweep) {
  const samples::accuracy::Case& c = *sweep.accuracy_case;
  std::string out = std::string(c.id) + " " + std::string(c.name) + ": " + std::string(c.shows) + "\n";
  out += format("  %s, %s; target %.1e at 4 sub-steps\n", std::string(c.metric).c_str(), inUnit(c.unit).c_str(), c.target);
  for (const bench::SweepCurve& curve : sweep.curves) {
    out += "  " + curve.solver + "\n    sub-steps         error    ns a step   us per simulated s\n";
    for (const bench::SweepPoint& p : curve.points)
      out += format("    %9d  %+12.3e  %11.0f  %19.3f%s\n", p.substeps, p.error, p.ns_per_step, 1e-3 * p.ns_per_second,
                    std::abs(p.error) <= c.target ? "  *" : "");
    out += summaryLine(curve, c);
  }
  return out;
}

std::string profileText(const bench::Profile& profile) {
  std::string out = format("performance profile over %zu cases: share solved at no more than this ratio of the best cost\n",
                           profile.cases);
  out += format("  %-26s %6s %6s %6s %6s %7s %8s\n", "solver", "1", "2", "5", "10", "100", "any");
  for (const bench::ProfileCurve& c : profile.curves) {
    out += format("  %-26s", c.solver.c_str());
    for (const double ratio : {1.0, 2.0, 5.0, 10.0, 100.0, 1e300})
      out += format(" %4.0f %%", 100.0 * bench::shareAt(profile, c, ratio));
    out += "\n";
  }
  return out;
}

ordered_json sweepJson(const bench::Sweep& sweep) {
  const samples::accuracy::Case& c = *sweep.accuracy_case;
  ordered_json json = {{"id", c.id},         {"case", c.name},   {"metric", c.metric}, {"unit", inUnit(c.unit)},
                       {"target", c.target}, {"floor", c.floor}, {"seconds", c.seconds}, {"dt", samples::kTimeStep},
                       {"solvers", ordered_json::array()}};
  for (const bench::SweepCurve& curve : sweep.curves) {
    ordered_json solver = {{"solver", curve.solver}, {"points", ordered_json::array()}};
    for (const bench::SweepPoint& p : curve.points)
      solver["points"].push_back({{"substeps", p.substeps},
                                  {"error", number(p.error)},
                                  {"ns_per_step", p.ns_per_step},
                                  {"ns_per_simulated_second", p.ns_per_second}});
    solver["cost_of_target"] = number(bench::costOfTarget(curve, c.target));
    if (c.smooth) {
      if (const auto order = bench::convergenceOrder(curve, c.floor)) solver["order"] = *order;
      if (const auto plateau = bench::plateauTest(curve, c.floor)) solver["plateau_test"] = plateau->passed;
    }
    json["solvers"].push_back(solver);
  }
  return json;
}

ordered_json profileJson(const bench::Profile& profile) {
  ordered_json json = {{"cases", profile.cases}, {"solvers", ordered_json::array()}};
  for (const bench::ProfileCurve& c : profile.curves)
    json["solvers"].push_back({{"solver", c.solver}, {"cost_ratios", c.ratios}});
  return json;
}

std::string sweepsCsv(const std::vector<bench::Sweep>& sweeps) {
  std::string out = "id,case,unit,solver,substeps,error,ns_per_step,ns_per_simulated_second\n";
  for (const bench::Sweep& sweep : sweeps)
    for (const bench::SweepCurve& curve : sweep.curves)
      for (const bench::SweepPoint& p : curve.points)
        out += format("%s,%s,%s,\"%s\",%d,%.6e,%.1f,%.1f\n", std::string(sweep.accuracy_case->id).c_str(),
                      std::string(sweep.accuracy_case->name).c_str(), inUnit(sweep.accuracy_case->unit).c_str(),
                      curve.solver.c_str(), p.substeps, p.error, p.ns_per_step, p.ns_per_second);
  return out;
}

std::string sweepSvg(const bench::Sweep& sweep) {
  const samples::accuracy::Case& c = *sweep.accuracy_case;
  std::string title(c.name);
  std::ranges::replace(title, '_', ' ');
  Diagram d{.title = title + " (" + std::string(c.id) + ")",
            .subtitle = std::string(c.shows) + "; 60 Hz, 1 to 64 sub-steps",
            .x_label = "processor time, µs per simulated second",
            .y_label = "largest error: " + std::string(c.metric) + ", " + inUnit(c.unit),
            .curves = {},
            .target = Diagram::Mark{c.target, "target at 4 sub-steps"},
            .floor = c.floor,
            .limits = {{1e4, "1 % of real time"}, {1e5, "10 %"}}};
  for (const bench::SweepCurve& curve : sweep.curves) {
    DiagramCurve& drawn = d.curves.emplace_back(DiagramCurve{curve.solver, {}});
    for (const bench::SweepPoint& p : curve.points)
      drawn.points.push_back({1e-3 * p.ns_per_second, std::max(std::abs(p.error), 0.1 * c.floor), std::to_string(p.substeps)});
  }
  return drawSvg(d);
}

std::string profileSvg(const bench::Profile& profile) {
  Diagram d{.form = Diagram::Form::Shares,
            .title = "performance profile",
            .subtitle = format("share of %zu accuracy cases brought below their target", profile.cases),
            .x_label = "cost, as a multiple of the cheapest solver of each case",
            .y_label = "share of cases",
            .curves = {},
            .target = {},
            .floor = {},
            .limits = {}};
  for (const bench::ProfileCurve& c : profile.curves) {
    DiagramCurve& drawn = d.curves.emplace_back(DiagramCurve{c.solver, {{1.0, 0.0, ""}}});
    for (const double ratio : c.ratios) drawn.points.push_back({ratio, bench::shareAt(profile, c, ratio), ""});
  }
  return drawSvg(d);
}

std::string missedBy(const bench::Sweep& sweep) {
  const samples::accuracy::Case& c = *sweep.accuracy_case;
  const bench::SweepCurve& ours = sweep.curves.front();
  std::string missed;
  const auto usual = std::ranges::find(ours.points, 4, &bench::SweepPoint::substeps);
  if (usual != ours.points.end() && !(std::abs(usual->error) <= c.target))
    missed = format("error %.2e at 4 sub-steps, target %.1e", usual->error, c.target);
  const auto plateau = bench::plateauTest(ours, c.floor);
  if (c.smooth && plateau && !plateau->passed)
    missed += format("%splateau, %.2e at 4 and %.2e at %d sub-steps", missed.empty() ? "" : "; ", plateau->coarse,
                     plateau->fine, plateau->substeps);
  return missed;
}

}  // namespace viewer
