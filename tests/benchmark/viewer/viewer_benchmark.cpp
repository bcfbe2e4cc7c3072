// What drawing costs: recording a list, comparing pictures, whole frames. Bounds that the viewer is to keep:
//   a list of 10,000 unchanged bodies under 1 ms, a comparison under 5 ms, a frame of 100 bodies under 25 ms,
//   one of 1,000 boxes and 20,000 triangles under 70 ms (offscreen, two processors, wall time).
#include <benchmark/benchmark.h>

#include <cmath>

#include "viewer/draw_list/recorder.h"
#include "viewer/image/metric.h"
#include "viewer/render/renderer.h"

namespace viewer {
namespace {

using pfx::Vec3;

Instance box(const Vec3& at) {
  return {at, pfx::Quat::Identity(), Vec3::Constant(0.4f), 0xffc07840u, 0, pickId(PickKind::Body, 1)};
}

void recordUnchangedBodies(benchmark::State& state) {
  DrawList list;
  Recorder recorder(list);
  const pfx::DebugRenderCallbacks c = recorder.callbacks();
  std::vector<pfx::SolidInstance> bodies;
  for (uint32_t i = 0; i < 10000; ++i)
    bodies.push_back({{Vec3(float(i), 0, 0), pfx::Quat::Identity()}, 0xff336699u, pfx::Finish::Soft, i});
  for (auto _ : state) {
    list.begin();
    c.define_solid(c.context, 100, pfx::Box{Vec3(1, 2, 3)});
    c.draw_solids(c.context, 100, bodies);
    list.end();
  }
}
BENCHMARK(recordUnchangedBodies)->Unit(benchmark::kMillisecond);

void comparePictures(benchmark::State& state) {
  Image a{640, 360, std::vector<uint8_t>(640 * 360 * 4, 100)}, b = a;
  for (size_t i = 0; i < b.rgba.size(); i += 97) b.rgba[i] = uint8_t(b.rgba[i] + i % 3);
  for (auto _ : state) benchmark::DoNotOptimize(measureDifference(a, b));
}
BENCHMARK(comparePictures)->Unit(benchmark::kMillisecond);

MeshData terrain(int cells) {
  std::vector<Vec3> points;
  std::vector<uint32_t> indices;
  for (int z = 0; z <= cells; ++z)
    for (int x = 0; x <= cells; ++x)
      points.push_back(0.4f * Vec3(float(x - cells / 2), 2.0f * float(std::sin(0.3 * x) * std::cos(0.2 * z)),
                                   float(z - cells / 2)));
  const auto row = uint32_t(cells + 1);
  for (uint32_t z = 0; z < uint32_t(cells); ++z)
    for (uint32_t x = 0; x < uint32_t(cells); ++x) {
      const uint32_t a = z * row + x, b = a + row;
      indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  return makeMesh(points, indices);
}

// Frames of boxes on a floor or on a terrain, in which everything moves.
void drawFrames(benchmark::State& state) {
  const int boxes = int(state.range(0)), cells = int(state.range(1));
  const auto context = makeContext({});
  Renderer renderer(*context);
  DrawList list;
  list.camera = orbitCamera({.target = Vec3(0, 1, 0), .distance = 30, .yaw_deg = 30, .pitch_deg = 25});
  float time = 0.0f;
  for (auto _ : state) {
    time += 0.01f;
    list.begin();
    if (cells > 0) {
      list.defineMesh(1000, cells > 0 ? terrain(cells) : MeshData{});
      list.add(1000, {.color = 0xffa0a890u});
    } else {
      list.add(kUnitBox, {.position = Vec3(0, -0.5f, 0), .scale = Vec3(40, 0.5f, 40), .finish = 1});
    }
    for (int i = 0; i < boxes; ++i) {
      const int side = std::max(1, int(std::sqrt(float(boxes))));
      list.add(kUnitBox, box(Vec3(0.6f * float(i % side - side / 2), 2.0f + std::sin(time + float(i)),
                                  0.6f * float(i / side - side / 2))));
    }
    list.end();
    renderer.draw({.width = 640, .height = 360}, list);
    benchmark::DoNotOptimize(renderer.readBack());
  }
}
BENCHMARK(drawFrames)->Args({100, 0})->Args({1000, 100})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace viewer
