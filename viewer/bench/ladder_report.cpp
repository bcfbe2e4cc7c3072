#include "viewer/bench/ladder_report.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "samples/benchmarks/engines/engine.h"
#include "samples/benchmarks/engines/processor_time.h"
#include "samples/benchmarks/ladder.h"

namespace viewer {
namespace {

namespace bench = samples::benchmarks;
using nlohmann::ordered_json;

constexpr int kBatches = 5, kSteps = 40;  // the least of the batches counts: noise only ever adds

struct RungScene final : samples::Scene {
  explicit RungScene(const bench::Rung& r) : rung(r) {}
  void build(pfx::World& world) override { rung.build(world); }
  const bench::Rung& rung;
};

// ns of a step, over the rung's bodies.
double costOfBody(bench::Engine& engine, int settle) {
  for (int i = 0; i < settle; ++i) engine.step(samples::kTimeStep);
  double best = 1e300;
  for (int batch = 0; batch < kBatches; ++batch) {
    const double begin = bench::processorSeconds();
    for (int i = 0; i < kSteps; ++i) engine.step(samples::kTimeStep);
    best = std::min(best, bench::processorSeconds() - begin);
  }
  return 1e9 * best / kSteps / bench::kLadderBodies;
}

ordered_json printStages(const bench::Rung& rung) {
  pfx::World world(rung.world);
  rung.build(world);
  for (int i = 0; i < rung.settle; ++i) world.step(samples::kTimeStep);
  std::vector<std::pair<std::string, double>> stages;
  for (int i = 0; i < kSteps; ++i) {
    world.step(samples::kTimeStep);
    for (const pfx::StageTime& t : world.stageTimes()) {
      auto row = std::ranges::find(stages, std::string(t.name), &std::pair<std::string, double>::first);
      if (row == stages.end()) row = stages.insert(row, {t.name, 0.0});
      row->second += 1e6 * t.milliseconds / kSteps / bench::kLadderBodies;
    }
  }
  ordered_json json = ordered_json::object();
  std::printf("  %-34s", std::string(rung.name).c_str());
  for (const auto& [name, ns] : stages) {
    std::printf("  %s %.1f", name.c_str(), ns);
    json[name] = ns;
  }
  std::printf("\n");
  return json;
}

}  // namespace

ordered_json runLadder() {
  const std::vector<bench::EngineKind> peers = bench::peers();
  std::printf("ladder: %d bodies, ns a body and step, one thread\n  %-34s %12s", bench::kLadderBodies, "", "pfx");
  for (const bench::EngineKind& peer : peers) std::printf(" %14s", peer.name.c_str());
  std::printf("\n");
  auto json = ordered_json::array();
  for (const bench::Rung& rung : bench::ladder()) {
    pfx::World start(rung.world);
    rung.build(start);
    const double ours = costOfBody(*bench::makePfxEngine(rung.world, std::make_unique<RungScene>(rung)), rung.settle);
    ordered_json row = {{"rung", rung.name}, {"pfx", ours}};
    std::printf("  %-34s %12.1f", std::string(rung.name).c_str(), ours);
    for (const bench::EngineKind& peer : peers) {
      const auto engine = peer.make(start);
      const double theirs = engine ? costOfBody(*engine, rung.settle) : 0.0;
      std::printf(" %14.1f", theirs);
      row[peer.name] = theirs;
    }
    if (rung.target_ns > 0.0) std::printf("  (target %.0f)", rung.target_ns);
    std::printf("\n");
    json.push_back(row);
  }
  std::printf("by stage, wall time\n");
  for (size_t i = 0; i < bench::ladder().size(); ++i) json[i]["stages"] = printStages(bench::ladder()[i]);
  return json;
}

}  // namespace viewer
