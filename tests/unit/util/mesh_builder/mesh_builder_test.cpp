// Large meshes: what is kept, what is dropped, what the edges are, in all four ways of storing.
#include "pfx/util/mesh_builder/mesh_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tests/support/meshes.h"

namespace pfx {
namespace {

constexpr LargeMeshType kTypes[] = {LargeMeshType::ExpandedArray, LargeMeshType::QuantizedArray,
                                    LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh};

LargeMesh build(const pfx_test::Soup& soup, LargeMeshOptions options = {}) {
  LargeMeshResult r = buildLargeMesh(soup.vertices, soup.indices, options);
  EXPECT_EQ(r.error, Error::Ok) << toString(r.error);
  return std::move(r.mesh);
}

// A unit cube of 12 triangles, front outside.
pfx_test::Soup cube() {
  pfx_test::Soup s;
  for (int i = 0; i < 8; ++i) s.vertices.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2 & 1));
  s.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return s;
}

TEST(MeshBuilder, keepsEachTriangleOnceAtItsPlaceInEveryType) {
  const auto soup = pfx_test::bumpyGrid(40, 0.5f);
  for (const LargeMeshType type : kTypes) {
    for (const bool high_quality : {false, true}) {
      const LargeMesh mesh = build(soup, {.type = type, .high_quality = high_quality});
      ASSERT_EQ(mesh.numFacets(), soup.numTriangles());
      std::set<uint32_t> seen(mesh.source.begin(), mesh.source.end());
      EXPECT_EQ(seen.size(), soup.numTriangles());
      // Half a cell of the grid per axis; nothing when expanded.
      const Vec3 cell = mesh.grid_scale * 0.501f + Vec3::Constant(isQuantized(type) ? 1e-6f : 0.0f);
      for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
        const auto v = facetVertices(mesh, f);
        for (int k = 0; k < 3; ++k) {
          // Welding rotates no triangle, so that corners keep their order.
          const Vec3 d = (v[k] - soup.vertices[soup.indices[3 * mesh.source[f] + k]]).cwiseAbs();
          ASSERT_TRUE((d.array() <= cell.array()).all());
        }
      }
    }
  }
}

TEST(MeshBuilder, islandsAreRunsOfAtMost64FacetsThatCoverAll) {
  for (const int n : {1, 5, 6, 40, 200}) {
    const auto soup = pfx_test::bumpyGrid(n, 0.5f);
    for (int k = 0; k < 8; ++k) {
      const LargeMesh mesh = build(soup, {.type = kTypes[k / 2], .high_quality = k % 2 != 0});
      uint32_t next = 0;
      for (uint32_t i = 0; i < mesh.islands.size(); ++i) {
        const MeshIsland& island = mesh.islands[i];
        ASSERT_EQ(island.first_facet, next);
        ASSERT_GE(island.num_facets, 1u);
        ASSERT_LE(island.num_facets, kMaxIslandFacets);
        next += island.num_facets;
        for (uint32_t f = island.first_facet; f < next; ++f) {
          ASSERT_EQ(islandOf(mesh, f), i);
          for (const Vec3& p : facetVertices(mesh, f)) {
            ASSERT_TRUE(island.bounds.contains(Aabb{p, p}));
          }
        }
      }
      EXPECT_EQ(next, mesh.numFacets());
    }
  }
}

TEST(MeshBuilder, aMeshOf512Times64TrianglesFits512Islands) {
  const auto soup = pfx_test::flatGrid(128, 1.0f);
  ASSERT_EQ(soup.numTriangles(), 32768u);
  for (const LargeMeshType type : kTypes) EXPECT_EQ(build(soup, {.type = type}).islands.size(), 512u);
}

TEST(MeshBuilder, hierarchyBoundsContainTheFacetsBelow) {
  const auto soup = pfx_test::bumpyGrid(60, 0.5f);
  const LargeMesh mesh = build(soup);
  uint32_t in_leaves = 0;
  for (const MeshNode& node : mesh.nodes) {
    for (int s = 0; s < 8; ++s) {
      const MeshChild c = node.child[s];
      if (c == kNoChild || !isLeaf(c)) continue;
      const Aabb box{{node.bounds[0][s], node.bounds[1][s], node.bounds[2][s]},
                     {node.bounds[3][s], node.bounds[4][s], node.bounds[5][s]}};
      for (uint32_t f = leafFirst(c); f < leafFirst(c) + leafCount(c); ++f, ++in_leaves) {
        for (const Vec3& p : facetVertices(mesh, f)) ASSERT_TRUE(box.contains(Aabb{p, p}));
      }
    }
  }
  EXPECT_EQ(in_leaves, mesh.numFacets());
}

TEST(MeshBuilder, quantizedMeshesTakeLessThanThreeQuartersOfTheMemory) {
  const auto soup = pfx_test::bumpyGrid(100, 0.5f);
  const auto bytes = [&](LargeMeshType type) { return static_cast<double>(memoryBytes(build(soup, {.type = type}))); };
  EXPECT_LT(bytes(LargeMeshType::QuantizedArray), 0.75 * bytes(LargeMeshType::ExpandedArray));
  EXPECT_LT(bytes(LargeMeshType::QuantizedBvh), 0.75 * bytes(LargeMeshType::ExpandedBvh));
}

TEST(MeshBuilder, cubeHasRightAngledConvexEdgesAndFlatDiagonals) {
  for (const LargeMeshType type : kTypes) {
    const LargeMesh mesh = build(cube(), {.type = type});
    int flat = 0, convex = 0;
    for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
      const MeshTriangle t = meshTriangle(mesh, f);
      for (int k = 0; k < 3; ++k) {
        flat += t.kind[k] == EdgeKind::Flat;
        convex += t.kind[k] == EdgeKind::Convex;
        // sin 45 degrees; a quantized tilt is off by half of 1 / 32767.
        if (t.kind[k] == EdgeKind::Convex) {
          EXPECT_NEAR(t.tilt[k], std::sqrt(0.5f), 2e-5f);
        }
        const uint32_t n = mesh.neighbors[f][k];
        ASSERT_NE(n, kNoFacet);
        EXPECT_EQ(mesh.neighbors[n >> 2][n & 3], f << 2 | k) << "neighbours name each other";
      }
    }
    EXPECT_EQ(flat, 12);
    EXPECT_EQ(convex, 24);
  }
}

TEST(MeshBuilder, cubeTurnedInsideOutIsConcaveAndAValleyToo) {
  auto soup = cube();
  for (size_t i = 0; i < soup.indices.size(); i += 3) std::swap(soup.indices[i], soup.indices[i + 1]);
  const LargeMesh mesh = build(soup);
  int concave = 0;
  for (const MeshFacet& f : mesh.facets) {
    for (int k = 0; k < 3; ++k) concave += f.kind[k] == EdgeKind::Concave && f.tilt[k] < 0.0f;
  }
  EXPECT_EQ(concave, 24);
}

TEST(MeshBuilder, edgesWithoutOneProperNeighbourAreOpen) {
  // Three triangles on one edge, and one neighbour that faces the other way.
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
  const std::vector<uint32_t> fan = {0, 1, 2, 1, 0, 3, 1, 0, 4}, flipped = {0, 1, 2, 0, 1, 3};
  for (const auto& indices : {fan, flipped}) {
    const LargeMeshResult r = buildLargeMesh(v, indices);
    ASSERT_EQ(r.error, Error::Ok);
    for (const MeshFacet& f : r.mesh.facets) {
      for (const EdgeKind kind : f.kind) EXPECT_EQ(kind, EdgeKind::Open);
    }
  }
}

TEST(MeshBuilder, weldsSeparateVerticesAtOnePosition) {
  const std::vector<Vec3> v = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {-0.0f, 0, 1}, {1, 0, 1}};
  const std::vector<uint32_t> indices = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(buildLargeMesh(v, indices).mesh.vertices.size(), 4u);
  EXPECT_EQ(buildLargeMesh(v, indices).mesh.facets[0].kind[1], EdgeKind::Flat);
  EXPECT_EQ(buildLargeMesh(v, indices, {.weld = false}).mesh.vertices.size(), 6u);
}

TEST(MeshBuilder, dropsAndCountsTrianglesWithoutAreaAndRepeatedOnes) {
  const std::vector<Vec3> v = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<uint32_t> indices = {0, 1, 2, 0, 0, 1, 0, 2, 3, 1, 2, 0, 2, 1, 0};
  const LargeMeshResult r = buildLargeMesh(v, indices);
  EXPECT_EQ(r.error, Error::Ok);
  EXPECT_EQ(r.dropped_degenerate, 2u);
  EXPECT_EQ(r.dropped_duplicate, 1u) << "the flipped one has another front and stays";
  EXPECT_EQ(r.mesh.numFacets(), 2u);
}

TEST(MeshBuilder, keepsSliversOfAspectTenThousand) {
  const std::vector<Vec3> v = {{0, 0, 0}, {0, 0, 1e-4f}, {1, 0, 0}};
  const LargeMeshResult r = buildLargeMesh(v, std::vector<uint32_t>{0, 1, 2});
  ASSERT_EQ(r.error, Error::Ok);
  EXPECT_EQ(r.mesh.facets[0].normal, Vec3(0, 1, 0));
}

TEST(MeshBuilder, refusesBadInputAndSaysWhere) {
  const std::vector<Vec3> v = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  const std::vector<uint32_t> i = {0, 1, 2};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(buildLargeMesh({}, i).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(v, {}).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(v, std::vector<uint32_t>{0, 0, 1}).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(v, std::vector<uint32_t>{0, 1}).error, Error::OutOfRange);
  const LargeMeshResult out = buildLargeMesh(v, std::vector<uint32_t>{0, 1, 2, 0, 1, 3});
  EXPECT_EQ(out.error, Error::OutOfRange);
  EXPECT_EQ(out.where, 1u);
  auto bad = v;
  bad[2].y() = nan;
  EXPECT_EQ(buildLargeMesh(bad, i).error, Error::InvalidValue);
  EXPECT_EQ(buildLargeMesh(bad, i).where, 2u);
  bad[2].y() = 1e30f;
  EXPECT_EQ(buildLargeMesh(bad, i).error, Error::InvalidValue);
  EXPECT_EQ(buildLargeMesh(v, i, {.thickness = -1.0f}).error, Error::InvalidValue);
  const std::vector<float> thickness = {nan};
  EXPECT_EQ(buildLargeMesh(v, i, {.triangle_thickness = thickness}).error, Error::InvalidValue);
  const std::vector<uint32_t> data = {1, 2};
  EXPECT_EQ(buildLargeMesh(v, i, {.user_data = data}).error, Error::OutOfRange);
}

TEST(MeshBuilder, carriesUserDataAndThicknessOfEachTriangle) {
  const auto soup = pfx_test::flatGrid(20, 1.0f);
  std::vector<uint32_t> data(soup.numTriangles());
  std::vector<float> thickness(soup.numTriangles());
  for (uint32_t i = 0; i < data.size(); ++i) data[i] = 1000 + i, thickness[i] = 0.001f * static_cast<float>(i);
  for (const LargeMeshType type : kTypes) {
    const LargeMesh mesh = build(soup, {.type = type, .triangle_thickness = thickness, .user_data = data});
    for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
      ASSERT_EQ(userData(mesh, f), 1000 + mesh.source[f]);
      // Half a step of 16 bits.
      ASSERT_NEAR(meshTriangle(mesh, f).thickness, thickness[mesh.source[f]],
                  isQuantized(type) ? mesh.max_thickness / 131070.0f * 1.01f : 0.0f);
    }
    EXPECT_FLOAT_EQ(mesh.bounds.max.y(), thickness.back());
  }
}

TEST(MeshBuilder, replacedVerticesGiveTheMeshThatABuildWouldGive) {
  const auto before = pfx_test::flatGrid(30, 0.5f), after = pfx_test::bumpyGrid(30, 0.5f);
  for (const LargeMeshType type : kTypes) {
    LargeMesh moved = build(before, {.type = type});
    const LargeMesh built = build(after, {.type = type});
    ASSERT_EQ(replaceVertices(moved, after.vertices), Error::Ok);
    EXPECT_EQ(moved.surface_bounds.max, built.surface_bounds.max);
    std::vector<uint32_t> place(built.numFacets());
    for (uint32_t f = 0; f < built.numFacets(); ++f) place[built.source[f]] = f;
    // The builder compares normals of neighbours; in another triangulation order of a block rounding may differ by one
    // unit of the stored 16 bits.
    const float step = isQuantized(type) ? 3.1e-5f : 0.0f;
    for (uint32_t f = 0; f < moved.numFacets(); ++f) {
      const MeshTriangle a = meshTriangle(moved, f), b = meshTriangle(built, place[moved.source[f]]);
      ASSERT_EQ(a.vertex, b.vertex);
      ASSERT_LE((a.normal - b.normal).norm(), step);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(a.tilt[k], b.tilt[k], step);
    }
  }
}

TEST(MeshBuilder, replacingVerticesRefusesBadInputAndLeavesTheMeshAlone) {
  auto soup = pfx_test::flatGrid(4, 1.0f);
  LargeMesh mesh = build(soup);
  EXPECT_EQ(replaceVertices(mesh, std::span(soup.vertices).first(3)), Error::OutOfRange);
  soup.vertices[7].z() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(replaceVertices(mesh, soup.vertices), Error::InvalidValue);
  EXPECT_TRUE(mesh.surface_bounds.max.allFinite());
}

}  // namespace
}  // namespace pfx
