// The speed-against-error sweeps as text, JSON, CSV and diagrams.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "samples/benchmarks/engines/sweep_summary.h"

namespace viewer {

// A table of one case, with order, plateau and cost of the target of each solver.
std::string sweepText(const samples::benchmarks::Sweep& sweep);
std::string profileText(const samples::benchmarks::Profile& profile);

nlohmann::ordered_json sweepJson(const samples::benchmarks::Sweep& sweep);
nlohmann::ordered_json profileJson(const samples::benchmarks::Profile& profile);

// One line a point; the first line names the columns.
std::string sweepsCsv(const std::vector<samples::benchmarks::Sweep>& sweeps);

std::string sweepSvg(const samples::benchmarks::Sweep& sweep);
std::string profileSvg(const samples::benchmarks::Profile& profile);

// What our default solver misses in this case: its target at 4 sub-steps, or the plateau test of a smooth case. Empty
// when it misses nothing.
std::string missedBy(const samples::benchmarks::Sweep& sweep);

}  // namespace viewer
