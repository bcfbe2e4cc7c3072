// The ladder of effects: the same number of bodies, and one more physical effect on each rung, so that the cost of an
// effect is the difference of two rungs.
#pragma once

#include <span>
#include <string_view>

#include "pfx/high_level/world/world.h"

namespace samples::benchmarks {

inline constexpr int kLadderBodies = 400;  // of each rung, besides the floor

struct Rung {
  std::string_view name;   // "spinning boxes"
  void (*build)(pfx::World& world);  // into an empty world
  pfx::WorldDef world = {};
  int settle = 60;           // steps before it is timed
  double target_ns = 0.0;    // a body and step; 0: none
};

std::span<const Rung> ladder();

}  // namespace samples::benchmarks
