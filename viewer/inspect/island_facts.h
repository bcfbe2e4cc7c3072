// What is known of an island: its members, what links them, and why it is awake.
#pragma once

#include "viewer/inspect/body_facts.h"

namespace viewer {

struct SleepFacts {
  uint32_t fastest = 0;  // body index of the member that is furthest above or nearest to the sleep velocity
  float linear_speed = 0.0f;   // m/s, of that body
  float angular_speed = 0.0f;  // rad/s
  uint32_t least_rested = 0;   // body index of the member that was slow for the fewest steps
  uint32_t slow_steps = 0;     // those steps
  std::string why;             // one sentence
};

// Of an island of the world (index < world.numIslands()).
SleepFacts explainSleep(const pfx::World& world, uint32_t island);

// Joints that link a body of the island, ascending.
std::vector<uint32_t> jointsOf(const pfx::World& world, const pfx::IslandView& island);

// What solved it in the last step, in words.
std::string solverName(const pfx::World& world, uint32_t island);

// {"id", "bodies", "contacts", "joints", "asleep", "sleep_timer", "why", "solver", ...}
Json islandJson(const pfx::World& world, uint32_t island);

}  // namespace viewer
