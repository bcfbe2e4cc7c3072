// Rays against exact answers: the table of rational results, and a closed sphere that no ray may leave.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pfx/base_level/ray/ray.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

using nlohmann::json;

json table(const char* part) {
  std::ifstream file(std::string(VITRINE_SOURCE_DIR) + "/tests/accuracy/ref/raycast.json");
  return json::parse(file)[part];
}

Eigen::Vector3d vec(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

// The triangle in the middle of a plane of its copies: all coordinates stay dyadic, edges and vertices are shared.
pfx_test::Soup tiling(const Vec3& a, const Vec3& b, const Vec3& c) {
  pfx_test::Soup soup;
  const auto id = [](int i, int j) { return static_cast<uint32_t>((j + 2) * 6 + i + 2); };
  for (int j = -2; j < 4; ++j) {
    for (int i = -2; i < 4; ++i) soup.vertices.push_back(a + float(i) * (b - a) + float(j) * (c - a));
  }
  for (int j = -2; j < 3; ++j) {
    for (int i = -2; i < 3; ++i) {
      for (const uint32_t v : {id(i, j), id(i + 1, j), id(i, j + 1)}) soup.indices.push_back(v);
      for (const uint32_t v : {id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)}) soup.indices.push_back(v);
    }
  }
  return soup;
}

// Hits on edges and vertices must be found by one of the triangles that share them; misses are of the one triangle.
TEST(AccRaycast, trianglesAgreeWithTheExactTable) {
  const json rows = table("triangles");
  int hits = 0, misses = 0;
  for (const json& row : rows) {
    const Eigen::Vector3d o = vec(row["origin"]), d = vec(row["dir"]);
    const Vec3 a = vec(row["a"]).cast<float>(), b = vec(row["b"]).cast<float>(), c = vec(row["c"]).cast<float>();
    const std::string kind = row["kind"];
    for (const LargeMeshType type : {LargeMeshType::ExpandedArray, LargeMeshType::ExpandedBvh}) {
      const pfx_test::Soup soup = row["hit"].get<bool>() ? tiling(a, b, c) : pfx_test::Soup{{a, b, c}, {0, 1, 2}};
      const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices, {.type = type}).mesh;
      // Longer than the table's ray, by a power of two: the hit lies at one half, and nothing is lost to the end.
      const ShapeHit hit = castRay({o, 2.0 * d, 1.0, FacetMode::Both}, mesh);
      ASSERT_EQ(hit.hit, row["hit"].get<bool>()) << kind;
      if (!hit.hit) {
        ++misses;
        continue;
      }
      ++hits;
      // Four units in the last place of a float.
      EXPECT_NEAR(2.0 * hit.fraction, row["t"].get<double>(), 4 * 6e-8) << kind;
      // The very end of a ray counts.
      EXPECT_TRUE(castRay({o, d, 1.0, FacetMode::Both}, mesh).hit) << kind;
    }
  }
  EXPECT_EQ(hits, 48);
  EXPECT_EQ(misses, 32);
}

TEST(AccRaycast, grazingSpheresAgreeWithTheExactTable) {
  const json rows = table("spheres");
  for (const json& row : rows) {
    const double scale = 262144.0;  // the table's t is in units of the direction and exceeds one
    const LocalRay ray{vec(row["origin"]) - vec(row["center"]), scale * vec(row["dir"])};
    const ShapeHit hit = castRay(ray, Sphere{row["radius"].get<float>()});
    ASSERT_EQ(hit.hit, row["hit"].get<bool>());
    if (!hit.hit) continue;
    const double t = row["t"].get<double>(), conditioning = row["conditioning"].get<double>();
    // In doubles: four units of the larger of t and the closest approach, times the conditioning.
    EXPECT_NEAR(hit.fraction * scale, t, 4 * 2.3e-16 * std::max(t, 1.0) * (1.0 + conditioning));
  }
}

TEST(AccRaycast, boxesAgreeWithTheExactTable) {
  const json rows = table("boxes");
  for (const json& row : rows) {
    const double scale = 1024.0;
    const LocalRay ray{vec(row["origin"]), scale * vec(row["dir"])};
    const Box box{vec(row["half"]).cast<float>()};
    const ShapeHit hit = castRay(ray, box);
    const bool inside = (ray.start.cwiseAbs().array() <= box.half_extent.cast<double>().array()).all();
    ASSERT_EQ(hit.hit, row["hit"].get<bool>() && !inside) << "from inside only back faces are met";
    if (hit.hit) {
      EXPECT_NEAR(hit.fraction * scale, row["t_float"].get<double>(), 1e-14);
    }
  }
}

struct Leaks {
  int leaks = 0;
  double worst_normal = 0.0;  // rad
};

// From inside a closed sphere of 20,480 triangles at its vertices and along its edges.
Leaks shootFromInside(LargeMeshType type, uint32_t num_rays) {
  const auto soup = pfx_test::icosphere(32, 1.0f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices, {.type = type}).mesh;
  Leaks result;
  uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  for (uint32_t i = 0; i < num_rays; ++i) {
    const uint32_t facet = static_cast<uint32_t>(random() * mesh.numFacets());
    const auto v = facetVertices(mesh, facet);
    const int k = static_cast<int>(random() * 3.0);
    const float along = i % 2 == 0 ? 0.0f : static_cast<float>(random());
    const Vec3 target = v[k] + along * (v[(k + 1) % 3] - v[k]);
    const double x = random(), y = random(), z = random();
    const Eigen::Vector3d start = i % 3 == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(x - 0.5, y - 0.5, z - 0.5);
    const Eigen::Vector3d direction = 2.5 * (target.cast<double>() - start).normalized();
    const ShapeHit hit = castRay({start, direction, 1.0, FacetMode::Both}, mesh);
    if (!hit.hit) {
      ++result.leaks;
      continue;
    }
    const Eigen::Vector3d radial = (start + hit.fraction * direction).normalized();
    result.worst_normal = std::max(result.worst_normal, (radial + hit.normal.cast<double>()).norm());
  }
  return result;
}

TEST(AccRaycast, noRayLeavesAClosedMeshThroughItsEdgesOrVertices) {
  const Leaks expanded = shootFromInside(LargeMeshType::ExpandedBvh, 1000000);
  std::printf("  ACC-30 leaks of 1,000,000 rays at shared edges and vertices: %d\n", expanded.leaks);
  EXPECT_EQ(expanded.leaks, 0);
  // Facets of a sphere divided 32 times lean from the radius by at most half their size, 0.7 / 32.
  EXPECT_LT(expanded.worst_normal, 0.03);
  EXPECT_EQ(shootFromInside(LargeMeshType::QuantizedBvh, 200000).leaks, 0);
  EXPECT_EQ(shootFromInside(LargeMeshType::ExpandedArray, 3000).leaks, 0);
  EXPECT_EQ(shootFromInside(LargeMeshType::QuantizedArray, 3000).leaks, 0);
}

}  // namespace
}  // namespace pfx
