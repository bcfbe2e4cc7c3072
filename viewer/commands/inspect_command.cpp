// vitrine inspect: the facts of the inspector panels as text or JSON.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"
#include "viewer/input_error.h"
#include "viewer/run/scene_run.h"
#include "viewer/run/sleep_facts.h"

namespace viewer {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string target;
  int frame = 0;
  bool islands = false, contacts = false, json = false;
};

ordered_json vectorJson(const pfx::Vec3& v) { return {v.x(), v.y(), v.z()}; }

ordered_json bodyJson(const pfx::World& world, uint32_t index) {
  return {{"index", index}, {"name", world.name(index)}};
}

ordered_json islandsJson(const pfx::World& world) {
  auto islands = ordered_json::array();
  for (uint32_t i = 0; i < world.numIslands(); ++i) {
    const pfx::IslandView view = world.island(i);
    auto bodies = ordered_json::array();
    for (uint32_t body : view.bodies) bodies.push_back(bodyJson(world, body));
    const SleepFacts sleep = explainSleep(world, i);
    ordered_json fastest = bodyJson(world, sleep.fastest);
    fastest["linear_speed"] = sleep.linear_speed;
    fastest["angular_speed"] = sleep.angular_speed;
    islands.push_back({{"id", i},
                       {"bodies", std::move(bodies)},
                       {"contacts", view.contacts.size()},
                       {"joints", view.joints},
                       {"asleep", view.asleep},
                       {"sleep_timer", view.sleep_timer},
                       {"why", sleep.why},
                       {"fastest", std::move(fastest)}});
  }
  return islands;
}

// The points of a pair: positions on body A in the world, impulses of the last step along the normal.
ordered_json pointsJson(const pfx::World& world, const pfx::Pair& pair) {
  auto points = ordered_json::array();
  const pfx::Transform pose = world.states()[pair.body_a].pose();
  for (const pfx::ContactManifold& m : world.manifolds(pair))
    for (int k = 0; k < m.num_points; ++k) {
      const pfx::ContactPoint& p = m.points[size_t(k)];
      points.push_back({{"position", vectorJson(pose.apply(p.local_a))},
                        {"normal", vectorJson(m.normal)},
                        {"distance", p.distance},
                        {"impulse", p.normal_impulse},
                        {"friction_impulse", vectorJson(p.friction_impulse)},
                        {"feature", p.feature}});
    }
  return points;
}

ordered_json contactsJson(const pfx::World& world) {
  auto contacts = ordered_json::array();
  for (const pfx::Pair& pair : world.contactPairs()) {
    ordered_json points = pointsJson(world, pair);
    if (points.empty()) continue;
    contacts.push_back({{"body_a", bodyJson(world, pair.body_a)},
                        {"body_b", bodyJson(world, pair.body_b)},
                        {"points", std::move(points)}});
  }
  return contacts;
}

ordered_json inspectScene(const SceneSpec& spec, const Options& options) {
  SceneRun run(spec);
  run.stepTo(uint64_t(options.frame));
  const pfx::WorldCounts counts = run.world().counts();
  ordered_json json = {{"target", spec.target()},
                       {"frame", options.frame},
                       {"counts",
                        {{"bodies", counts.bodies},
                         {"awake", counts.awake},
                         {"pairs", counts.pairs},
                         {"touching_pairs", counts.touching_pairs},
                         {"contact_points", counts.contact_points},
                         {"islands", counts.islands},
                         {"joints", counts.joints}}}};
  if (options.islands) json["islands"] = islandsJson(run.world());
  if (options.contacts) json["contacts"] = contactsJson(run.world());
  return json;
}

std::string nameOf(const ordered_json& body) {
  const auto name = body["name"].get<std::string>();
  return (name.empty() ? "body" : name) + " #" + std::to_string(body["index"].get<uint32_t>());
}

// The first few by name; --json has all.
std::string memberList(const ordered_json& bodies) {
  constexpr size_t kShown = 8;
  std::string members;
  for (size_t i = 0; i < std::min(kShown, bodies.size()); ++i)
    members += (i > 0 ? ", " : "") + nameOf(bodies[i]);
  if (bodies.size() > kShown) members += " and " + std::to_string(bodies.size() - kShown) + " more";
  return members;
}

void printText(const ordered_json& json) {
  std::printf("%s, frame %d\n", json["target"].get<std::string>().c_str(), json["frame"].get<int>());
  for (const auto& [key, value] : json["counts"].items())
    std::printf("  %-16s%u\n", key.c_str(), value.get<uint32_t>());
  if (json.contains("islands")) {
    std::printf("\nisland  bodies  contacts  still for s  why, members\n");
    for (const auto& island : json["islands"]) {
      const std::string members = memberList(island["bodies"]);
      std::printf("%6u  %6zu  %8zu  %11.2f  %s\n%39s%s\n", island["id"].get<uint32_t>(),
                  island["bodies"].size(), island["contacts"].get<size_t>(),
                  island["sleep_timer"].get<double>(), island["why"].get<std::string>().c_str(), "",
                  members.c_str());
    }
  }
  if (json.contains("contacts")) {
    std::printf(
        "\ncontacts: position (m), normal from the first to the second, distance (m), impulse (N s)\n");
    for (const auto& contact : json["contacts"]) {
      std::printf("%s - %s\n", nameOf(contact["body_a"]).c_str(), nameOf(contact["body_b"]).c_str());
      for (const auto& p : contact["points"])
        std::printf("  (%.4f, %.4f, %.4f)  (%.3f, %.3f, %.3f)  %+.6f  %.5f\n", p["position"][0].get<double>(),
                    p["position"][1].get<double>(), p["position"][2].get<double>(),
                    p["normal"][0].get<double>(), p["normal"][1].get<double>(), p["normal"][2].get<double>(),
                    p["distance"].get<double>(), p["impulse"].get<double>());
    }
  }
}

int inspect(Options options) {
  if (!options.islands && !options.contacts) options.islands = options.contacts = true;
  const SceneSpec scene = findScene(allScenes(), options.target);
  const ordered_json json = inspectScene(scene, options);
  if (options.json)
    std::puts(json.dump(2).c_str());
  else
    printText(json);
  return 0;
}

}  // namespace

void addInspectCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("inspect", "Islands and contacts of one frame, as text or JSON");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->target, "SAMPLE/SCENE")->required();
  command->add_option("--frame", options->frame, "Steps to run first")
      ->check(CLI::Range(0, 1000000))
      ->required();
  command->add_flag("--islands", options->islands, "Only islands (with --contacts: both)");
  command->add_flag("--contacts", options->contacts, "Only contacts");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([&action, options] { action = [options] { return inspect(*options); }; });
}

}  // namespace viewer
