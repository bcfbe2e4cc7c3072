// Islands, colours, and what it costs to share work, per item.
#include <benchmark/benchmark.h>

#include <numeric>
#include <vector>

#include "pfx/low_level/island/colouring.h"
#include "pfx/low_level/island/islands.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {
namespace {

// A block of boxes, each linked with three neighbours.
std::vector<Link> gridLinks(uint32_t n) {
  std::vector<Link> links;
  for (uint32_t i = 0; i < n * n * n; ++i) {
    if (i % n + 1 < n) links.push_back({i, i + 1});
    if (i / n % n + 1 < n) links.push_back({i, i + n});
    if (i / n / n + 1 < n) links.push_back({i, i + n * n});
  }
  return links;
}

void islandsOfAGrid(benchmark::State& state) {
  const auto links = gridLinks(25);
  std::vector<uint32_t> active(25 * 25 * 25);
  std::iota(active.begin(), active.end(), 0u);
  Islands islands;
  for (auto _ : state) islands.build(static_cast<uint32_t>(active.size()), active, links);
  state.counters["ns_per_link"] =
      benchmark::Counter(static_cast<double>(links.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(islandsOfAGrid);

void coloursOfAGrid(benchmark::State& state) {
  const auto links = gridLinks(25);
  const std::vector<uint8_t> dynamic(25 * 25 * 25, 1);
  Colouring colouring;
  for (auto _ : state) colouring.build(links, dynamic);
  state.counters["colours"] = static_cast<double>(colouring.size());
  state.counters["ns_per_link"] =
      benchmark::Counter(static_cast<double>(links.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(coloursOfAGrid);

void tinyRange(benchmark::State& state) {
  TaskManager tasks(static_cast<int>(state.range(0)));
  std::vector<float> data(256, 1.0f);
  for (auto _ : state) {
    tasks.parallelFor(256, 64, [&](TaskRange r) {
      for (uint32_t i = r.begin; i < r.end; ++i) data[i] *= 1.0001f;
    });
    benchmark::ClobberMemory();
  }
}
BENCHMARK(tinyRange)->Arg(1)->Arg(2);

}  // namespace
}  // namespace pfx
