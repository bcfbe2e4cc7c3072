#include "viewer/bench/race_report.h"

#include <algorithm>
#include <cstdio>

#include "samples/benchmarks/engines/race.h"
#include "viewer/run/figures.h"

namespace viewer {
namespace {

namespace bench = samples::benchmarks;
using nlohmann::ordered_json;

// A run of our engine, stage by stage.
struct StageRun {
  std::vector<std::pair<std::string, double>> ms;  // mean of a step, in the order of the stages
  Figures end;
  uint64_t state_hash;
};

StageRun runStages(const bench::Case& c, int threads, int steps) {
  pfx::WorldDef def = c.world;
  def.workers = threads;
  pfx::World world(def);
  const auto scene = c.make();
  scene->build(world);
  StageRun run = {};
  for (int i = 0; i < steps; ++i) {
    scene->beforeStep(world, samples::kTimeStep);
    world.step(samples::kTimeStep);
    for (const pfx::StageTime& t : world.stageTimes()) {
      auto row = std::find_if(run.ms.begin(), run.ms.end(), [&](const auto& r) { return r.first == t.name; });
      if (row == run.ms.end()) row = run.ms.insert(row, {t.name, 0.0});
      row->second += t.milliseconds / steps;
    }
  }
  run.end = computeFigures(world);
  run.state_hash = world.stateHash();
  return run;
}

void printRace(std::span<const bench::Result> results) {
  std::printf("  %-24s %10s %10s %10s %10s %12s\n", "engine", "cpu ms", "wall ms", "ratio", "worst ms", "drift m");
  for (const bench::Result& r : results) {
    if (!r.supported)
      std::printf("  %-24s cannot run this scene\n", r.engine.c_str());
    else
      std::printf("  %-24s %10.3f %10.3f %10.2f %10.3f %12.4g\n", r.engine.c_str(), r.cpu_ms.median,
                  r.ms_per_step.median, r.ratio.median, r.worst_ms, r.largest_drift);
  }
}

ordered_json resultJson(const bench::Result& r) {
  if (!r.supported) return {{"engine", r.engine}, {"supported", false}};
  return {
      {"engine", r.engine},
      {"supported", true},
      {"ms_per_step",
       {{"median", r.ms_per_step.median}, {"lower", r.ms_per_step.lower}, {"upper", r.ms_per_step.upper}}},
      {"cpu_ms_per_step", r.cpu_ms.median},
      {"ratio", r.ratio.median},
      {"worst_ms", r.worst_ms},
      {"kinetic_energy", r.kinetic_energy},
      {"largest_drift", r.largest_drift}};
}

ordered_json stagesJson(const bench::Case& c, int threads, int steps) {
  const StageRun run = runStages(c, threads, steps);
  ordered_json ms = ordered_json::object();
  std::printf("  stages, %d thread%s\n", threads, threads == 1 ? "" : "s");
  for (const auto& [stage, time] : run.ms) {
    std::printf("    %-22s %10.4f ms\n", stage.c_str(), time);
    ms[stage] = time;
  }
  std::printf("    at the end: penetration %.2e m, joint error %.2e m, %u bodies awake, %u contacts\n",
              run.end.max_penetration, run.end.max_joint_error, run.end.counts.awake, run.end.counts.contact_points);
  return {{"threads", threads},
          {"ms_per_step", ms},
          {"max_penetration", run.end.max_penetration},
          {"max_joint_error", run.end.max_joint_error}};
}

}  // namespace

ordered_json runRace(const bench::Case& c, const RaceOptions& options) {
  const int steps = options.steps > 0 ? options.steps : c.steps;
  std::vector<bench::EngineKind> contestants;
  for (const int n : options.threads) contestants.push_back(bench::pfxEngine(c, n));
  if (options.peers)
    for (const bench::EngineKind& peer : bench::peers()) contestants.push_back(peer);
  std::fprintf(stderr, "bench: %s, %d steps in %zu engines\n", std::string(c.name).c_str(), steps, contestants.size());
  const std::vector<bench::Result> results = bench::race(c, contestants, steps);

  std::printf("%s: %s\n", std::string(c.name).c_str(), std::string(c.shows).c_str());
  printRace(results);
  ordered_json json = {{"case", c.name},
                       {"steps", steps},
                       {"engines", ordered_json::array()},
                       {"stages", ordered_json::array()}};
  for (const bench::Result& r : results) json["engines"].push_back(resultJson(r));
  for (const int n : options.threads) json["stages"].push_back(stagesJson(c, n, steps));
  std::printf("\n");
  return json;
}

}  // namespace viewer
