// Cost of the narrow phase per pair in falling piles, ours and, over the same motion, that of the engines installed.
#include <benchmark/benchmark.h>

#include <string_view>

#include "tests/benchmark/low_level/narrow_phase_peers.h"
#include "tests/benchmark/low_level/pile_scenes.h"

namespace pfx_test {
namespace {

double collisionSeconds(const World& world) {
  double seconds = 0.0;
  for (const StageTime& t : world.stageTimes())
    if (std::string_view(t.name) == "collision") seconds = 1e-3 * t.milliseconds;
  return seconds;
}

// Steps to state.range(0). In each further step the collision stage is timed, and every other engine finds the contacts
// of the same bodies at the same places, with what it remembers of the step before.
void narrowPhase(benchmark::State& state, World (*make)()) {
  World world = make();
  for (int64_t i = 0; i < state.range(0); ++i) world.step(kStep);
  const auto peers = narrowPhasePeers(world);
  double seconds = 0.0, pairs = 0.0, touching = 0.0;
  std::vector<PeerCost> costs(peers.size());
  for (auto _ : state) {
    world.step(kStep);
    const double stage = collisionSeconds(world);
    state.SetIterationTime(stage);
    seconds += stage;
    pairs += world.counts().pairs;
    touching += world.counts().touching_pairs;
    for (size_t k = 0; k < peers.size(); ++k) {
      const PeerCost cost = peers[k]->findContacts(world);
      costs[k].seconds += cost.seconds, costs[k].pairs += cost.pairs;
    }
  }
  const auto steps = static_cast<double>(state.iterations());
  state.counters["us_per_pair"] = 1e6 * seconds / pairs;
  state.counters["pairs"] = pairs / steps;
  state.counters["touching"] = touching / steps;
  for (size_t k = 0; k < peers.size(); ++k) {
    state.counters[std::string(peers[k]->name()) + "_ms"] = 1e3 * costs[k].seconds / steps;
    state.counters[std::string(peers[k]->name()) + "_us_per_pair"] = 1e6 * costs[k].seconds / costs[k].pairs;
    state.counters[std::string(peers[k]->name()) + "_pairs"] = costs[k].pairs / steps;
  }
}

BENCHMARK_CAPTURE(narrowPhase, convexPile, convexPile)
    ->Arg(60)
    ->Arg(150)
    ->UseManualTime()
    ->Iterations(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(narrowPhase, junkyard, junkyard)
    ->Arg(60)
    ->Arg(150)
    ->Arg(300)
    ->UseManualTime()
    ->Iterations(20)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pfx_test
