#include "viewer/inspect/island_facts.h"

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

std::vector<uint32_t> jointsOf(const pfx::World& world, const pfx::IslandView& island) {
  std::vector<uint32_t> joints;
  const auto links = world.jointLinks();
  for (uint32_t i = 0; i < links.size(); ++i)
    if (links[i].exists && (std::ranges::binary_search(island.bodies, links[i].body_a) ||
                            std::ranges::binary_search(island.bodies, links[i].body_b)))
      joints.push_back(i);
  return joints;
}

std::string solverName(const pfx::World& world, uint32_t island) {
  const pfx::IslandView view = world.island(island);
  if (view.asleep) return "asleep";
  const pfx::IslandSolvers solvers = world.islandSolvers(island);
  std::string name;
  if (!view.contacts.empty()) name = solvers.newton ? "Newton's method" : "sequential impulses";
  const auto add = [&](const char* part) { name += (name.empty() ? "" : ", ") + std::string(part); };
  if (solvers.direct_joints) add("joints directly");
  if (solvers.soft_joints) add("joints softly");
  return name.empty() ? "free flight" : name;
}

Json islandJson(const pfx::World& world, uint32_t island) {
  const pfx::IslandView view = world.island(island);
  const SleepFacts sleep = explainSleep(world, island);
  Json bodies = Json::array(), pairs = Json::array(), joints = Json::array();
  for (uint32_t body : view.bodies) bodies.push_back(bodyRef(world, body));
  for (uint32_t i : view.contacts) {
    const pfx::Pair& pair = world.contactPairs()[i];
    pairs.push_back({bodyRef(world, pair.body_a), bodyRef(world, pair.body_b)});
  }
  for (uint32_t joint : jointsOf(world, view)) joints.push_back(jointRef(world, joint));
  Json fastest = bodyRef(world, sleep.fastest);
  fastest["linear_speed"] = sleep.linear_speed;
  fastest["angular_speed"] = sleep.angular_speed;
  return {{"id", island},
          {"bodies", std::move(bodies)},
          {"contacts", view.contacts.size()},
          {"joints", view.joints},
          {"asleep", view.asleep},
          {"sleep_timer", view.sleep_timer},
          {"why", sleep.why},
          {"solver", solverName(world, island)},
          {"fastest", std::move(fastest)},
          {"contact_pairs", std::move(pairs)},
          {"joint_list", std::move(joints)}};
}

}  // namespace viewer
