// Chapter 2: what islands, hierarchies, build quality and quantization are for: fewer triangles looked at, less memory, no
// slower steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/shape/mesh_query.h"
#include "tests/compat/scene.h"
#include "tests/compat/terrain.h"

using namespace compat_tests;

namespace {

size_t taken = 0;  // bytes, of the mesh that is being made
void* measuredAlloc(size_t align, size_t size) { return taken += size, std::aligned_alloc(align, (size + align - 1) / align * align); }
void* noRealloc(void*, size_t, size_t) { return nullptr; }

double processorSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Mesh {
  PfxLargeTriMesh mesh;
  size_t bytes;
  double build_seconds;
  explicit Mesh(const PfxCreateLargeTriMeshParam& param) {
    pfxSetUtilityAllocator(measuredAlloc, noRealloc, std::free);
    taken = 0;
    const double start = processorSeconds();
    EXPECT_EQ(pfxCreateLargeTriMesh(mesh, param), SCE_PFX_OK);
    build_seconds = processorSeconds() - start;
    bytes = taken;
  }
  ~Mesh() {
    pfxReleaseLargeTriMesh(mesh);
    pfxSetUtilityAllocator(nullptr, nullptr, nullptr);
  }
  Mesh(const Mesh&) = delete;

  // What detection looks at for a box of half extent 0.5 m, the mean over 2000 places on the ground: triangles, and the runs
  // that they lie in.
  struct LookedAt {
    double triangles = 0.0, runs = 0.0;
  };
  LookedAt lookedAt(PfxFloat side) const {
    std::mt19937 random(3);
    LookedAt mean;
    for (int i = 0; i < 2000; ++i) {
      const auto at = [&] { return static_cast<float>(random() % 10000) * 1e-4f * side; };
      const pfx::Vec3 p(at(), 0.5f, at()), half(0.5f, 0.5f, 0.5f);
      pfx::visitFacets(*mesh.m_native, {p - half, p + half}, [&mean](uint32_t, uint32_t count) { mean.triangles += count / 2000.0, mean.runs += 1 / 2000.0; });
    }
    return mean;
  }
};

constexpr PfxUInt32 kBoth = SCE_PFX_MESH_FLAG_USE_BVH | SCE_PFX_MESH_FLAG_USE_QUANTIZED;

TEST(CompatMeshSearch, C2_42ASmallBodyLooksAtFewOfManyTriangles) {
  const Terrain terrain(128);
  for (const PfxUInt32 flag : {0u, SCE_PFX_MESH_FLAG_USE_QUANTIZED, SCE_PFX_MESH_FLAG_USE_BVH, kBoth}) {
    const Mesh m(terrain.param(flag));
    const double seen = m.lookedAt(128.0f).triangles;
    std::printf("type %d: %.1f of %u triangles\n", m.mesh.m_type, seen, m.mesh.m_numFacets);
    EXPECT_LT(seen, 0.01 * m.mesh.m_numFacets);
    EXPECT_GE(seen, 2.0);
  }
}

TEST(CompatMeshSearch, C2_50AHierarchyLooksAtFewerTrianglesThanAnArrayC2_51AndTakesMemoryOfItsOwn) {
  const Terrain terrain(100);
  for (const PfxUInt32 quantized : {0u, SCE_PFX_MESH_FLAG_USE_QUANTIZED}) {
    const Mesh array(terrain.param(quantized)), tree(terrain.param(quantized | SCE_PFX_MESH_FLAG_USE_BVH));
    const double in_array = array.lookedAt(100.0f).triangles, in_tree = tree.lookedAt(100.0f).triangles;
    std::printf("%s: array %.1f triangles, %zu bytes; hierarchy %.1f triangles, %zu bytes\n", quantized ? "quantized" : "expanded",
                in_array, array.bytes, in_tree, tree.bytes);
    EXPECT_LT(in_tree, 0.5 * in_array);
    EXPECT_GT(tree.bytes, array.bytes);
    EXPECT_LT(tree.bytes, 1.5 * array.bytes);
  }
}

// Splinters of all lengths in all directions, as a town's walls and roofs are: there the order of building matters.
struct Splinters {
  std::vector<PfxFloat> verts;
  std::vector<PfxUInt32> indices;
  Splinters() {
    std::mt19937 random(8);
    const auto at = [&random](PfxFloat range) { return static_cast<PfxFloat>(random() % 10000) * 1e-4f * range; };
    for (PfxUInt32 i = 0; i < 20000; ++i) {
      const PfxFloat x = at(100.0f), z = at(100.0f), length = i % 50 == 0 ? 20.0f : 0.5f;
      for (const PfxFloat v : {x, 0.0f, z, x + at(length), at(1.0f), z + at(length), x + at(0.5f), at(1.0f), z + at(0.5f)}) verts.push_back(v);
      for (PfxUInt32 k = 0; k < 3; ++k) indices.push_back(3 * i + k);
    }
  }
  PfxCreateLargeTriMeshParam param(PfxUInt32 flag) const {
    PfxCreateLargeTriMeshParam p;
    p.flag = flag | SCE_PFX_MESH_FLAG_32BIT_INDEX;
    p.verts = verts.data(), p.numVerts = static_cast<PfxUInt32>(verts.size() / 3);
    p.triangles = indices.data(), p.numTriangles = static_cast<PfxUInt32>(indices.size() / 3);
    p.triangleStrideBytes = 3 * sizeof(PfxUInt32);
    return p;
  }
};

// An array is searched for triangles in islands, a hierarchy for runs of up to four triangles.
TEST(CompatMeshSearch, C2_52HighQualityTakesLongerToBuildAndLooksAtLess) {
  const Splinters splinters;
  for (const PfxUInt32 flag : {0u, SCE_PFX_MESH_FLAG_USE_BVH}) {
    const Mesh plain(splinters.param(flag)), high(splinters.param(flag | SCE_PFX_MESH_FLAG_HIGH_QUALITY));
    const Mesh::LookedAt seen = plain.lookedAt(100.0f), seen_high = high.lookedAt(100.0f);
    std::printf("type %d: built in %.1f ms, %.1f triangles in %.2f runs; high quality: %.1f ms, %.1f in %.2f\n", plain.mesh.m_type,
                1e3 * plain.build_seconds, seen.triangles, seen.runs, 1e3 * high.build_seconds, seen_high.triangles, seen_high.runs);
    if (flag == 0) {
      EXPECT_LT(seen_high.triangles, 0.8 * seen.triangles);
    } else {
      EXPECT_LT(seen_high.runs, seen.runs);
    }
    EXPECT_GT(high.build_seconds, plain.build_seconds);
  }
}

// 64 boxes at rest on the terrain: only detection and refresh meet the mesh, so the whole step is timed. Steps of both meshes
// take turns, and the median is compared, so that other programs do not count.
TEST(CompatMeshSearch, C2_54AStepOnAQuantizedMeshTakesNoLonger) {
  const Terrain terrain(60);
  for (const PfxUInt32 bvh : {0u, SCE_PFX_MESH_FLAG_USE_BVH}) {
    const Mesh meshes[] = {Mesh(terrain.param(bvh)), Mesh(terrain.param(bvh | SCE_PFX_MESH_FLAG_USE_QUANTIZED))};
    Scene scenes[2];
    std::vector<double> seconds[2];
    for (int k = 0; k < 2; ++k) {
      PfxShape ground;
      ground.setLargeTriMesh(&meshes[k].mesh);
      scenes[k].add(ground, PfxVector3(0.0f), kPfxMotionTypeFixed);
      for (int i = 0; i < 64; ++i)
        scenes[k].addBox(PfxVector3(0.5f), PfxVector3(4.0f + 3.0f * static_cast<float>(i % 8), 0.7f, 4.0f + 3.0f * static_cast<float>(i / 8)), kPfxMotionTypeActive);
    }
    for (int step = 0; step < 240; ++step) {
      for (int k = 0; k < 2; ++k) {
        const double start = processorSeconds();
        scenes[k].step(1.0f / 60.0f, 5);
        if (step >= 60) seconds[k].push_back(processorSeconds() - start);
      }
    }
    double median[2];
    for (int k = 0; k < 2; ++k) std::nth_element(seconds[k].begin(), seconds[k].begin() + 90, seconds[k].end()), median[k] = seconds[k][90];
    std::printf("%s: a step takes %.0f us expanded, %.0f us quantized (%+.0f %%)\n", bvh ? "hierarchy" : "array", 1e6 * median[0],
                1e6 * median[1], 100.0 * (median[1] / median[0] - 1.0));
    EXPECT_LT(median[1], 1.2 * median[0]);
    for (int i = 1; i <= 64; ++i) EXPECT_NEAR(scenes[0].states[i].getPosition()[1], scenes[1].states[i].getPosition()[1], 0.02f);
  }
}

}  // namespace
