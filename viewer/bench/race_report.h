// One benchmark scene, raced by our engine and those of others, as text and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "samples/benchmarks/scenes.h"

namespace viewer {

struct RaceOptions {
  std::vector<int> threads = {1};  // ours runs once with each
  int steps = 0;                   // 0: as many as the scene says
  bool peers = true;
};

// Runs the race, prints its tables, and returns the figures.
nlohmann::ordered_json runRace(const samples::benchmarks::Case& scene, const RaceOptions& options);

}  // namespace viewer
