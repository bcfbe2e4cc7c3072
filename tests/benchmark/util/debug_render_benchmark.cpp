// What it costs to hand 10,000 bodies to the callbacks.
#include <benchmark/benchmark.h>

#include "pfx/util/debug_render/debug_render.h"

namespace pfx {
namespace {

struct Bodies {
  std::vector<RigidState> states{10000};
  std::vector<Collidable> collidables{10000};

  Bodies() {
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].position = Vec3(static_cast<float>(i % 100), 0.0f, static_cast<float>(i / 100));
      const float size = 0.2f + 0.05f * static_cast<float>(i % 8);
      if (i % 2 == 0) collidables[i].inline_shape.geometry = Box{Vec3::Constant(size)};
      if (i % 2 == 1) collidables[i].inline_shape.geometry = Sphere{size};
      collidables[i].half_extent = Vec3::Constant(size);
    }
  }
};

DebugRenderCallbacks counting(std::size_t* count) {
  DebugRenderCallbacks c;
  c.context = count;
  c.line = [](void* n, const Vec3&, const Vec3&, Color) { ++*static_cast<std::size_t*>(n); };
  c.aabb = [](void* n, const Vec3&, const Vec3&, Color) { ++*static_cast<std::size_t*>(n); };
  c.draw_solids = [](void* n, uint64_t, std::span<const SolidInstance> s) {
    *static_cast<std::size_t*>(n) += s.size();
  };
  return c;
}

void solids(benchmark::State& state) {
  const Bodies bodies;
  std::size_t count = 0;
  DebugRender debug(counting(&count));
  for (auto _ : state) debug.renderSolids(bodies.states, bodies.collidables);
  benchmark::DoNotOptimize(count);
}
BENCHMARK(solids)->Unit(benchmark::kMillisecond);

void boxesAndAxes(benchmark::State& state) {
  const Bodies bodies;
  std::size_t count = 0;
  DebugRender debug(counting(&count));
  for (auto _ : state) {
    debug.renderAabb(bodies.states, bodies.collidables);
    debug.renderLocalAxis(bodies.states);
  }
  benchmark::DoNotOptimize(count);
}
BENCHMARK(boxesAndAxes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pfx
