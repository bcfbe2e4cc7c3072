// Cost of pair finding: a tumbling pile, a large field of which little moves, a large resting world.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <vector>

#include "pfx/low_level/broadphase/sweep.h"
#include "pfx/low_level/broadphase/tree_broadphase.h"

namespace pfx {
namespace {

BroadphaseProxy boxProxy(uint32_t body, const Vec3& center, float half) {
  BroadphaseProxy p;
  p.body = body;
  p.bounds = Aabb{center, center}.grown(half);
  return p;
}

// Boxes of half size 0.2 m that turn about the z axis like laundry: 25 degrees a second, each a little on its
// own.
struct TumblingPile {
  explicit TumblingPile(uint32_t count) : noise(1) {
    for (uint32_t i = 0; proxies.size() < count; ++i) {
      const Vec3 at(-9.0f + 0.42f * static_cast<float>(i % 43), -14.0f + 0.42f * static_cast<float>(i / 2021),
                    -9.8f + 0.42f * static_cast<float>(i / 43 % 47));
      if (at.head<2>().norm() > 15.0f) continue;
      proxies.push_back(boxProxy(static_cast<uint32_t>(proxies.size()), at, 0.26f));
    }
  }
  void step() {
    constexpr float kSin = 0.00727f, kCos = 0.99997f;  // 25 degrees / 60
    for (BroadphaseProxy& p : proxies) {
      const Vec3 c = p.bounds.center();
      const float wobble = uniform(noise);
      const Vec3 next(kCos * c.x() - kSin * c.y() + wobble, kSin * c.x() + kCos * c.y() - wobble,
                      c.z() + 0.5f * wobble);
      p.bounds.min += next - c;
      p.bounds.max += next - c;
    }
  }
  std::mt19937 noise;
  std::uniform_real_distribution<float> uniform{-0.01f, 0.01f};
  std::vector<BroadphaseProxy> proxies;
};

void pileWithSweep(benchmark::State& state) {
  TumblingPile pile(8000);
  TaskManager tasks(static_cast<int>(state.range(0)));
  SweepBroadphase sweep;
  std::size_t pairs = 0;
  for (auto _ : state) {
    state.PauseTiming();
    pile.step();
    state.ResumeTiming();
    pairs = sweep.findPairs(pile.proxies, axisOfLargestVariance(pile.proxies), &tasks).size();
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}
BENCHMARK(pileWithSweep)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(100);

void pileWithTree(benchmark::State& state) {
  TumblingPile pile(8000);
  TaskManager tasks(static_cast<int>(state.range(0)));
  TreeBroadphase tree;
  std::size_t pairs = 0;
  for (auto _ : state) {
    state.PauseTiming();
    pile.step();
    state.ResumeTiming();
    tree.update(pile.proxies, &tasks);
    pairs = tree.pairs().size();
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}
BENCHMARK(pileWithTree)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(100);

// 100,000 boxes in a field 100 m wide.
std::vector<BroadphaseProxy> field() {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> wide(-50.0f, 50.0f), low(0.0f, 20.0f);
  std::vector<BroadphaseProxy> proxies;
  for (uint32_t i = 0; i < 100000; ++i) {
    const float x = wide(random);
    const float y = low(random);
    const float z = wide(random);
    proxies.push_back(boxProxy(i, Vec3(x, y, z), 0.4f));
  }
  return proxies;
}

// One in a hundred moves; with all awake, or with the others asleep.
void fieldWithTree(benchmark::State& state) {
  auto proxies = field();
  const bool all_awake = state.range(0) != 0;
  TreeBroadphase tree;
  tree.rest(proxies);
  std::vector<BroadphaseProxy> active;
  for (std::size_t i = 0; i < proxies.size(); i += all_awake ? 1 : 100) active.push_back(proxies[i]);
  tree.update(active);
  float shift = 0.1f;
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = 0; i < active.size(); i += all_awake ? 100 : 1) {
      active[i].bounds.min.x() += shift, active[i].bounds.max.x() += shift;
    }
    if (state.iterations() % 50 == 0) shift = -shift;
    state.ResumeTiming();
    tree.update(active);
    benchmark::DoNotOptimize(tree.activePairs().data());
  }
  state.counters["pairs"] = static_cast<double>(tree.activePairs().size());
}
BENCHMARK(fieldWithTree)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(100);

void fieldWithSweep(benchmark::State& state) {
  const auto proxies = field();
  SweepBroadphase sweep;
  for (auto _ : state) benchmark::DoNotOptimize(sweep.findPairs(proxies, 0).data());
}
BENCHMARK(fieldWithSweep)->Unit(benchmark::kMillisecond)->Iterations(3);

// 1,000,000 fixed slabs side by side.
std::vector<BroadphaseProxy> slabs() {
  std::vector<BroadphaseProxy> proxies;
  for (uint32_t i = 0; i < 1000000; ++i) {
    const Vec3 at(10.0f * static_cast<float>(i % 1000), 0.0f, 10.0f * static_cast<float>(i / 1000));
    BroadphaseProxy p = boxProxy(i, at, 5.0f);
    p.bounds.min.y() = -0.25f, p.bounds.max.y() = 0.25f;
    p.motion_type = MotionType::Fixed;
    proxies.push_back(p);
  }
  return proxies;
}

void insertMillionFixed(benchmark::State& state) {
  const auto proxies = slabs();
  for (auto _ : state) {
    TreeBroadphase tree;
    tree.rest(proxies);
    tree.update({});
    state.counters["height"] = static_cast<double>(tree.restingTree().height());
    state.counters["bytes_each"] = static_cast<double>(tree.memoryBytes()) / 1e6;
  }
}
BENCHMARK(insertMillionFixed)->Unit(benchmark::kMillisecond)->Iterations(2);

void hundredMoveOverMillionFixed(benchmark::State& state) {
  TreeBroadphase tree;
  tree.rest(slabs());
  std::vector<BroadphaseProxy> active;
  for (uint32_t i = 0; i < 100; ++i) {
    const Vec3 at(1000.0f + 800.0f * static_cast<float>(i % 10), 0.7f,
                  1000.0f + 800.0f * static_cast<float>(i / 10));
    active.push_back(boxProxy(1000000 + i, at, 0.5f));
  }
  tree.update(active);
  for (auto _ : state) {
    for (BroadphaseProxy& p : active) p.bounds.min.x() += 0.05f, p.bounds.max.x() += 0.05f;
    tree.update(active);
    benchmark::DoNotOptimize(tree.activePairs().data());
  }
}
BENCHMARK(hundredMoveOverMillionFixed)->Unit(benchmark::kMicrosecond)->Iterations(1000);

}  // namespace
}  // namespace pfx
