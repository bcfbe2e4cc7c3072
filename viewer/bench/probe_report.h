// The quality probes, ours at 4 and 8 sub-steps beside what a survey saw elsewhere.
#pragma once

#include <nlohmann/json.hpp>

namespace viewer {

// Runs every probe, prints the table, and returns it.
nlohmann::ordered_json runProbes();

}  // namespace viewer
