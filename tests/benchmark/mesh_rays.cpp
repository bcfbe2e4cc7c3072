// Rays on a mesh of a million triangles and the time to build it, beside Embree where that is installed.
//
// Coherent rays are a camera's, in rows; incoherent ones start and point anywhere in the bounds of the mesh.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#ifdef VITRINE_HAS_EMBREE
#include <embree3/rtcore.h>
#endif

#include "pfx/base_level/ray/ray.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace {

using pfx::Vec3;

constexpr int kSquares = 707;  // 2 * 707^2 = 999,698 triangles
constexpr int kNumRays = 1 << 16;

const pfx_test::Soup& soup() {
  static const pfx_test::Soup s = pfx_test::bumpyGrid(kSquares, 0.1f);
  return s;
}

const pfx::LargeMesh& mesh(pfx::LargeMeshType type, bool high_quality) {
  static std::map<std::pair<pfx::LargeMeshType, bool>, pfx::LargeMesh> built;
  auto& m = built[{type, high_quality}];
  if (m.numFacets() == 0) {
    m = pfx::buildLargeMesh(soup().vertices, soup().indices, {.type = type, .high_quality = high_quality}).mesh;
  }
  return m;
}

std::vector<pfx::LocalRay> makeRays(bool coherent) {
  std::vector<pfx::LocalRay> rays(kNumRays);
  uint64_t state = 99;
  const auto random = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  for (int i = 0; i < kNumRays; ++i) {
    auto& r = rays[i];
    r.facet_mode = pfx::FacetMode::Both;
    if (coherent) {
      const double x = (i % 256) / 255.0 - 0.5, y = (i / 256) / 255.0 - 0.5;
      r.start = {0.0, 20.0, 40.0};
      r.direction = 120.0 * Eigen::Vector3d(x, 0.7 * y - 0.45, -1.0);
    } else {
      const double x = random(), y = random(), z = random(), u = random(), v = random(), w = random();
      r.start = {70.0 * (x - 0.5), 4.0 * (y - 0.4), 70.0 * (z - 0.5)};
      r.direction = 80.0 * Eigen::Vector3d(u - 0.5, 0.3 * (v - 0.5), w - 0.5).normalized();
    }
  }
  return rays;
}

void build(benchmark::State& state) {
  for (auto _ : state) {
    const auto r = pfx::buildLargeMesh(soup().vertices, soup().indices,
                                       {.type = static_cast<pfx::LargeMeshType>(state.range(0)),
                                        .high_quality = state.range(1) != 0});
    benchmark::DoNotOptimize(r.mesh.numFacets());
  }
}
BENCHMARK(build)->ArgNames({"type", "high_quality"})->ArgsProduct({{2, 3}, {0, 1}})->Unit(benchmark::kMillisecond);

void single(benchmark::State& state) {
  const auto rays = makeRays(state.range(0) != 0);
  const auto& m = mesh(static_cast<pfx::LargeMeshType>(state.range(1)), state.range(2) != 0);
  int64_t hits = 0;
  for (auto _ : state) {
    for (const auto& ray : rays) hits += pfx::castRay(ray, m).hit;
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * kNumRays);
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(single)->ArgNames({"coherent", "type", "high_quality"})->ArgsProduct({{0, 1}, {2, 3}, {0, 1}});

void batch(benchmark::State& state) {
  const auto rays = makeRays(state.range(0) != 0);
  const auto& m = mesh(static_cast<pfx::LargeMeshType>(state.range(1)), true);
  std::vector<pfx::ShapeHit> hits(rays.size());
  for (auto _ : state) {
    pfx::castRays(rays, m, hits);
    benchmark::DoNotOptimize(hits.data());
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * kNumRays);
}
BENCHMARK(batch)->ArgNames({"coherent", "type"})->ArgsProduct({{0, 1}, {2, 3}});

#ifdef VITRINE_HAS_EMBREE
class EmbreeScene {
 public:
  explicit EmbreeScene(bool robust) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, soup().vertices.size());
    void* i = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, soup().numTriangles());
    std::copy_n(reinterpret_cast<const char*>(soup().vertices.data()), 12 * soup().vertices.size(), static_cast<char*>(v));
    std::copy_n(reinterpret_cast<const char*>(soup().indices.data()), 4 * soup().indices.size(), static_cast<char*>(i));
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RTCScene get() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

void embreeSingle(benchmark::State& state) {
  const auto rays = makeRays(state.range(0) != 0);
  const EmbreeScene scene(state.range(1) != 0);
  int64_t hits = 0;
  for (auto _ : state) {
    for (const auto& ray : rays) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit r{};
      r.ray.org_x = float(ray.start.x()), r.ray.org_y = float(ray.start.y()), r.ray.org_z = float(ray.start.z());
      r.ray.dir_x = float(ray.direction.x()), r.ray.dir_y = float(ray.direction.y()), r.ray.dir_z = float(ray.direction.z());
      r.ray.tfar = 1.0f;
      r.ray.mask = ~0u;
      r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene.get(), &context, &r);
      hits += r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * kNumRays);
  state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(embreeSingle)->ArgNames({"coherent", "robust"})->ArgsProduct({{0, 1}, {0, 1}});

void embreeBatch(benchmark::State& state) {
  const auto rays = makeRays(state.range(0) != 0);
  const EmbreeScene scene(state.range(1) != 0);
  std::vector<RTCRayHit> stream(rays.size());
  for (auto _ : state) {
    for (size_t i = 0; i < rays.size(); ++i) {
      const auto& ray = rays[i];
      RTCRayHit& r = stream[i];
      r = {};
      r.ray.org_x = float(ray.start.x()), r.ray.org_y = float(ray.start.y()), r.ray.org_z = float(ray.start.z());
      r.ray.dir_x = float(ray.direction.x()), r.ray.dir_y = float(ray.direction.y()), r.ray.dir_z = float(ray.direction.z());
      r.ray.tfar = 1.0f;
      r.ray.mask = ~0u;
      r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = state.range(0) != 0 ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect1M(scene.get(), &context, stream.data(), static_cast<unsigned>(stream.size()), sizeof(RTCRayHit));
    benchmark::DoNotOptimize(stream.data());
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * kNumRays);
}
BENCHMARK(embreeBatch)->ArgNames({"coherent", "robust"})->ArgsProduct({{0, 1}, {0, 1}});
#endif

}  // namespace

BENCHMARK_MAIN();
