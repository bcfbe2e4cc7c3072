// Why an island is awake.
#include "viewer/run/sleep_facts.h"

#include <algorithm>
#include <cstdio>

namespace viewer {
namespace {

std::string bodyName(const pfx::World& world, uint32_t body) {
  const std::string_view name = world.name(body);
  return (name.empty() ? "body" : std::string(name)) + " #" + std::to_string(body);
}

std::string explain(const pfx::World& world, const pfx::IslandView& island, const SleepFacts& f) {
  const pfx::WorldDef& def = world.def();
  if (island.asleep) return "asleep";
  if (!def.sleeping) return "awake: sleeping is off in this scene";
  const auto states = world.states();
  for (uint32_t body : island.bodies)
    if (!states[body].can_sleep) return "awake: " + bodyName(world, body) + " may not sleep";
  char text[160];
  if (std::max(f.linear_speed, f.angular_speed) >= def.sleep_velocity) {
    std::snprintf(text, sizeof text, " moves with %.3g m/s and %.3g rad/s, an island sleeps below %.3g",
                  double(f.linear_speed), double(f.angular_speed), double(def.sleep_velocity));
    return "awake: " + bodyName(world, f.fastest) + text;
  }
  std::snprintf(text, sizeof text, " has been slow for %u of %u steps", f.slow_steps, def.sleep_steps);
  return "awake: " + bodyName(world, f.least_rested) + text;
}

}  // namespace

SleepFacts explainSleep(const pfx::World& world, uint32_t island) {
  const pfx::IslandView view = world.island(island);
  const auto states = world.states();
  SleepFacts f;
  f.slow_steps = ~0u;
  float fastest = -1.0f;
  for (uint32_t body : view.bodies) {
    const float linear = states[body].linear_velocity.norm(), angular = states[body].angular_velocity.norm();
    if (std::max(linear, angular) > fastest) {
      fastest = std::max(linear, angular);
      f.fastest = body, f.linear_speed = linear, f.angular_speed = angular;
    }
    if (states[body].sleep_count < f.slow_steps)
      f.least_rested = body, f.slow_steps = states[body].sleep_count;
  }
  f.why = explain(world, view, f);
  return f;
}

}  // namespace viewer
