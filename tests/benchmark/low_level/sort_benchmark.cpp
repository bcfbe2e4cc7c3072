// The record sort beside std::sort.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

#include "pfx/low_level/sort/radix_sort.h"

namespace pfx {
namespace {

template <class Record>
std::vector<Record> randomRecords(std::size_t count) {
  std::mt19937 random(1);
  std::vector<Record> records(count);
  for (Record& r : records) r.key_value = random();
  return records;
}

template <class Record>
void radixSort(benchmark::State& state) {
  const auto source = randomRecords<Record>(static_cast<std::size_t>(state.range(0)));
  TaskManager tasks(static_cast<int>(state.range(1)));
  std::vector<Record> data, work(source.size());
  for (auto _ : state) {
    state.PauseTiming();
    data = source;
    state.ResumeTiming();
    sort(std::span(data), std::span(work), &tasks);
  }
}
BENCHMARK_TEMPLATE(radixSort, SortRecord16)
    ->Args({100000, 1})
    ->Args({1000000, 1})
    ->Args({1000000, 2})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK_TEMPLATE(radixSort, SortRecord32)
    ->Args({1000000, 1})
    ->Args({1000000, 2})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

template <class Record>
void standardSort(benchmark::State& state) {
  const auto source = randomRecords<Record>(static_cast<std::size_t>(state.range(0)));
  std::vector<Record> data;
  for (auto _ : state) {
    state.PauseTiming();
    data = source;
    state.ResumeTiming();
    std::sort(data.begin(), data.end(), [](const Record& a, const Record& b) { return a.key() < b.key(); });
  }
}
BENCHMARK_TEMPLATE(standardSort, SortRecord16)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);
BENCHMARK_TEMPLATE(standardSort, SortRecord32)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace
}  // namespace pfx
