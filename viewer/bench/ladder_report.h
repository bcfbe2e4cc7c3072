// What one effect after the other costs: ns a body and step, ours beside the peers, and ours by stage.
#pragma once

#include <nlohmann/json.hpp>

namespace viewer {

// Runs every rung, prints the tables, and returns the figures.
nlohmann::ordered_json runLadder();

}  // namespace viewer
