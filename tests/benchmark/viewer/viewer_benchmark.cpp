// What drawing costs: recording a list, comparing pictures, whole frames. Bounds that the viewer is to keep:
//   a list of 10,000 unchanged bodies under 1 ms, a comparison under 5 ms, a frame of 100 bodies under 25 ms,
//   one of 1,000 boxes and 20,000 triangles under 70 ms (offscreen, two processors, wall time).
// Processor time when this was written: 0.08 ms, 0.62 ms, 34 ms and 93 ms, of which the last two are shared by two
// processors at about 0.55 of it each.
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

// Boxes that all move, on a floor or on a terrain of so many cells a side (two triangles each).
class MovingBoxes {
 public:
  MovingBoxes(int boxes, int cells) : boxes_(boxes) {
    list_.camera = orbitCamera({.target = Vec3(0, 1, 0), .distance = 30, .yaw_deg = 30, .pitch_deg = 25});
    if (cells > 0) list_.defineMesh(kTerrain, terrain(cells));
  }

  const DrawList& next() {
    time_ += 0.01f;
    list_.begin();
    if (list_.hasMesh(kTerrain))
      list_.add(kTerrain, {.color = 0xffa0a890u});
    else
      list_.add(kUnitBox, {.position = Vec3(0, -0.5f, 0), .scale = Vec3(40, 0.5f, 40), .finish = 1});
    const int side = std::max(1, int(std::sqrt(float(boxes_))));
    for (int i = 0; i < boxes_; ++i)
      list_.add(kUnitBox, box(Vec3(0.6f * float(i % side - side / 2), 2.0f + std::sin(time_ + float(i)),
                                   0.6f * float(i / side - side / 2))));
    list_.end();
    return list_;
  }

 private:
  static constexpr uint64_t kTerrain = 1000;
  int boxes_;
  float time_ = 0.0f;
  DrawList list_;
};

// The processor time is that of all threads: on two idle processors a frame takes a little more than half of it.
void drawFrames(benchmark::State& state) {
  MovingBoxes scene(int(state.range(0)), int(state.range(1)));
  const auto context = makeContext({});
  Renderer renderer(*context);
  const FrameInput frame{.width = 640, .height = 360};
  for (int i = 0; i < 3; ++i) renderer.draw(frame, scene.next());  // shaders are compiled when they are first used
  for (auto _ : state) {
    renderer.draw(frame, scene.next());
    benchmark::DoNotOptimize(renderer.readBack());
  }
}
BENCHMARK(drawFrames)
    ->Args({100, 0})
    ->Args({1000, 100})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace viewer
