// vitrine bench: time a step of the benchmark scenes, by stage and beside the peers that are installed.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "samples/benchmarks/race.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/file.h"
#include "viewer/input_error.h"
#include "viewer/run/scene_spec.h"

namespace viewer {
namespace {

namespace bench = samples::benchmarks;
using nlohmann::ordered_json;

struct Options {
  std::vector<std::string> cases;
  std::string threads = "1", json;
  int steps = 0;  // 0: as many as the case says
};

std::vector<const bench::Case*> findCases(const std::vector<std::string>& names) {
  std::vector<const bench::Case*> found;
  for (const bench::Case& c : bench::cases())
    if (names.empty() || std::find(names.begin(), names.end(), c.name) != names.end()) found.push_back(&c);
  for (const std::string& name : names) {
    const auto same = [&](const bench::Case* c) { return c->name == name; };
    if (std::any_of(found.begin(), found.end(), same)) continue;
    std::string known;
    for (const bench::Case& c : bench::cases()) known += (known.empty() ? "" : ", ") + std::string(c.name);
    throw InputError("unknown case \"" + name + "\"; known: " + known);
  }
  return found;
}

// Mean ms of each stage in a step of our engine.
std::vector<std::pair<std::string, double>> stageTable(const bench::Case& c, int threads, int steps) {
  pfx::World world(pfx::WorldDef{.workers = threads});
  c.build(world);
  std::vector<std::pair<std::string, double>> table;
  for (int i = 0; i < steps; ++i) {
    world.step(samples::kTimeStep);
    for (const pfx::StageTime& t : world.stageTimes()) {
      auto row = std::find_if(table.begin(), table.end(), [&](const auto& r) { return r.first == t.name; });
      if (row == table.end()) row = table.insert(row, {t.name, 0.0});
      row->second += t.milliseconds / steps;
    }
  }
  return table;
}

void printRace(std::span<const bench::Result> results) {
  std::printf("  %-24s %10s %10s %10s %12s\n", "engine", "ms a step", "ratio", "worst ms", "drift m");
  for (const bench::Result& r : results) {
    if (!r.supported)
      std::printf("  %-24s cannot run this scene\n", r.engine.c_str());
    else
      std::printf("  %-24s %10.3f %10.2f %10.3f %12.4g\n", r.engine.c_str(), r.ms_per_step.median,
                  r.ratio.median, r.worst_ms, r.largest_drift);
  }
}

ordered_json resultJson(const bench::Result& r) {
  if (!r.supported) return {{"engine", r.engine}, {"supported", false}};
  return {
      {"engine", r.engine},
      {"supported", true},
      {"ms_per_step",
       {{"median", r.ms_per_step.median}, {"lower", r.ms_per_step.lower}, {"upper", r.ms_per_step.upper}}},
      {"ratio", r.ratio.median},
      {"worst_ms", r.worst_ms},
      {"kinetic_energy", r.kinetic_energy},
      {"largest_drift", r.largest_drift}};
}

ordered_json runCase(const bench::Case& c, const std::vector<int>& threads, int steps) {
  std::vector<bench::EngineKind> contestants;
  for (int n : threads) {
    contestants.push_back(bench::pfxEngine(c, n));
  }
  for (const bench::EngineKind& peer : bench::peers()) contestants.push_back(peer);
  std::fprintf(stderr, "bench: %s, %d steps in %zu engines\n", std::string(c.name).c_str(), steps,
               contestants.size());
  const std::vector<bench::Result> results = bench::race(c, contestants, steps);

  std::printf("%s: %s\n", std::string(c.name).c_str(), std::string(c.shows).c_str());
  printRace(results);
  ordered_json json = {{"case", c.name},
                       {"steps", steps},
                       {"engines", ordered_json::array()},
                       {"stages", ordered_json::array()}};
  for (const bench::Result& r : results) json["engines"].push_back(resultJson(r));
  for (int n : threads) {
    ordered_json ms = ordered_json::object();
    std::printf("  stages, %d thread%s\n", n, n == 1 ? "" : "s");
    for (const auto& [stage, time] : stageTable(c, n, steps)) {
      std::printf("    %-22s %10.4f ms\n", stage.c_str(), time);
      ms[stage] = time;
    }
    json["stages"].push_back({{"threads", n}, {"ms_per_step", ms}});
  }
  std::printf("\n");
  return json;
}

int runBench(const Options& options) {
  const std::vector<int> threads = parseThreads(options.threads);
  auto all = ordered_json::array();
  for (const bench::Case* c : findCases(options.cases))
    all.push_back(runCase(*c, threads, options.steps > 0 ? options.steps : c->steps));
  if (!options.json.empty()) writeText(options.json, all.dump(2) + "\n");
  return 0;
}

}  // namespace

void addBenchCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("bench", "Time the benchmark scenes, by stage and beside installed peers");
  const auto options = std::make_shared<Options>();
  command->add_option("CASE", options->cases, "Benchmark scenes; none: all");
  command->add_option("--threads", options->threads, "Numbers of threads, for example 1,2")
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Steps of each; default as the case says")
      ->check(CLI::Range(1, 100000));
  command->add_option("--json", options->json, "Write the figures to a file");
  command->callback([&action, options] { action = [options] { return runBench(*options); }; });
}

}  // namespace viewer
