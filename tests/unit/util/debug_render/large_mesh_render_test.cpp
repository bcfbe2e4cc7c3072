// Debug drawing of large meshes, counted per flag.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/util/debug_render/debug_render.h"
#include "pfx/util/debug_render/geometry_key.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace pfx {
namespace {

// A flat sheet of n x n squares of one metre, in the plane y = 0, from the origin on.
LargeMesh sheet(uint32_t n, LargeMeshType type, float height = 0.0f) {
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j)
      vertices.emplace_back(static_cast<float>(i), height, static_cast<float>(j));
  }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      for (uint32_t index : {a, a + 1, b + 1, a, b + 1, b}) indices.push_back(index);
    }
  }
  return buildLargeMesh(vertices, indices, {.type = type, .thickness = 0.5f}).mesh;
}

struct Counts {
  std::size_t lines = 0, boxes = 0;
  std::vector<std::pair<Vec3, Vec3>> drawn;
  std::vector<Transform> box_poses;
  bool operator==(const Counts& other) const { return lines == other.lines && boxes == other.boxes; }
};

class LargeMeshRender : public ::testing::TestWithParam<LargeMeshType> {
 protected:
  LargeMeshRender() : mesh(sheet(12, GetParam())), states(3), collidables(3) {
    collidables[1].inline_shape.geometry = &mesh;
    collidables[1].inline_shape.offset.position = Vec3(0, 0, 5);
    states[1].position = Vec3(100, 0, 0);
    debug.callbacks.context = &counts;
    debug.callbacks.line = [](void* c, const Vec3& from, const Vec3& to, Color) {
      ++static_cast<Counts*>(c)->lines;
      static_cast<Counts*>(c)->drawn.emplace_back(from, to);
    };
    debug.callbacks.box = [](void* c, const Transform& pose, const Vec3&, Color) {
      ++static_cast<Counts*>(c)->boxes;
      static_cast<Counts*>(c)->box_poses.push_back(pose);
    };
  }
  Counts all(MeshDraw what) {
    counts = {};
    debug.renderLargeMesh(states, collidables, what);
    return counts;
  }
  const std::size_t triangles = 12 * 12 * 2;
  LargeMesh mesh;
  std::vector<RigidState> states;
  std::vector<Collidable> collidables;
  Counts counts;
  DebugRender debug;
};

TEST_P(LargeMeshRender, drawsWhatTheFlagsSay) {
  ASSERT_EQ(mesh.numFacets(), triangles);
  const std::size_t islands = mesh.islands.size();
  EXPECT_EQ(all(MeshDraw::None), (Counts{0, 0, {}, {}}));
  EXPECT_EQ(all(MeshDraw::Island), (Counts{0, islands, {}, {}}));
  EXPECT_EQ(all(MeshDraw::Edge), (Counts{3 * triangles, 0, {}, {}}));
  EXPECT_EQ(all(MeshDraw::FacetAabb), (Counts{0, triangles, {}, {}}));
  EXPECT_EQ(all(MeshDraw::Normal), (Counts{triangles, 0, {}, {}}));
  EXPECT_EQ(all(MeshDraw::Thickness), (Counts{0, 0, {}, {}}));  // only together with the edges
  EXPECT_EQ(all(MeshDraw::Edge | MeshDraw::Thickness), (Counts{9 * triangles, 0, {}, {}}));
  EXPECT_EQ(all(MeshDraw::All), (Counts{10 * triangles, islands + triangles, {}, {}}));
  debug.setVisible(1, false);
  EXPECT_EQ(all(MeshDraw::All), (Counts{0, 0, {}, {}}));
}

TEST_P(LargeMeshRender, drawsNormalsUpwardsAndLowerFacesBelowInTheWorld) {
  debug.scale = 2.0f;
  for (const auto& [from, to] : all(MeshDraw::Normal).drawn) {
    EXPECT_NEAR((to - from - Vec3(0, 2, 0)).norm(), 0.0f, 2e-4f);  // a quantized normal has 15 bits
    EXPECT_GT(from.x(), 99.9f);
    EXPECT_GT(from.z(), 4.9f);
  }
  float lowest = 0.0f;
  for (const auto& [from, to] : all(MeshDraw::Edge | MeshDraw::Thickness).drawn) {
    lowest = std::min({lowest, from.y(), to.y()});
  }
  EXPECT_NEAR(lowest, -0.5f, 1e-4f);
}

TEST_P(LargeMeshRender, keepsToTheIslandsInTheFrustumOrSphere) {
  const std::size_t islands = mesh.islands.size();
  ASSERT_GE(islands, 4u);
  const auto inFrustum = [&](std::vector<FrustumPlane> planes) {
    counts = {};
    debug.renderLargeMeshInFrustum(states, collidables, MeshDraw::Island, planes);
    return counts.boxes;
  };
  EXPECT_EQ(inFrustum({}), islands);
  EXPECT_EQ(inFrustum({{Vec3::UnitX(), -99.0f}}), islands);  // x >= 99
  EXPECT_EQ(inFrustum({{Vec3::UnitX(), -130.0f}}), 0u);      // x >= 130
  EXPECT_EQ(inFrustum({{Vec3::UnitX(), -99.0f}, {-Vec3::UnitX(), 90.0f}}), 0u);
  // A box in the middle of the sheet: brute force over the bounding spheres.
  std::size_t expected = 0;
  for (const MeshIsland& island : mesh.islands) {
    const Vec3 center = island.bounds.center() + Vec3(100, 0, 5);
    expected += center.x() >= 109.0f - island.bounds.halfExtent().norm();
  }
  EXPECT_EQ(inFrustum({{Vec3::UnitX(), -109.0f}}), expected);
  EXPECT_GT(expected, 0u);
  EXPECT_LT(expected, islands);

  counts = {};
  debug.renderLargeMeshInSphere(states, collidables, MeshDraw::Island, Vec3(106, 0, 11), 50.0f);
  EXPECT_EQ(counts.boxes, islands);
  counts = {};
  debug.renderLargeMeshInSphere(states, collidables, MeshDraw::Island, Vec3(0, 0, 0), 50.0f);
  EXPECT_EQ(counts.boxes, 0u);
}

TEST_P(LargeMeshRender, drawsMarkedTrianglesWithTheirOwnFlags) {
  const Collidable& collidable = collidables[1];
  EXPECT_EQ(debug.setLargeMeshFlag({1, 0, 0}, collidable, MeshDraw::Edge), Error::Ok);
  EXPECT_EQ(debug.setLargeMeshFlag({1, 0, 1}, collidable, MeshDraw::Normal | MeshDraw::Island), Error::Ok);
  EXPECT_EQ(debug.setLargeMeshFlag({1, 0, 2}, collidable, MeshDraw::All), Error::Ok);
  debug.renderLargeMeshByFlag(states, collidables);
  EXPECT_EQ(counts, (Counts{3 + 1 + 10, 1 + 1, {}, {}}));  // the island is drawn once
  EXPECT_EQ(debug.setLargeMeshFlag({1, 0, 2}, collidable, MeshDraw::None), Error::Ok);
  counts = {};
  debug.renderLargeMeshByFlag(states, collidables);
  EXPECT_EQ(counts, (Counts{4, 1, {}, {}}));

  const uint32_t islands = static_cast<uint32_t>(mesh.islands.size());
  EXPECT_EQ(debug.setLargeMeshFlag({1, islands, 0}, collidable, MeshDraw::All), Error::OutOfRange);
  EXPECT_EQ(debug.setLargeMeshFlag({1, 0, 64}, collidable, MeshDraw::All), Error::OutOfRange);
  EXPECT_EQ(debug.setLargeMeshFlag({0, 0, 0}, collidables[0], MeshDraw::All), Error::NullPointer);
}

INSTANTIATE_TEST_SUITE_P(Types, LargeMeshRender,
                         ::testing::Values(LargeMeshType::ExpandedArray, LargeMeshType::QuantizedArray,
                                           LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh));

TEST(GeometryKey, ofMeshesDependsOnTheirContentAndNotOnTheirPlace) {
  const LargeMesh a = sheet(5, LargeMeshType::ExpandedBvh), copy = a,
                  higher = sheet(5, LargeMeshType::ExpandedBvh, 1.0f);
  const LargeMesh quantized = sheet(5, LargeMeshType::QuantizedArray);
  EXPECT_EQ(geometryKey(&a), geometryKey(&copy));
  EXPECT_EQ((std::set<uint64_t>{geometryKey(&a), geometryKey(&higher), geometryKey(&quantized)}).size(), 3u);
  EXPECT_NE(geometryIdentity(&a), geometryIdentity(&copy));

  ConvexMesh hull, other;
  hull.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  other.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0)};
  const ConvexMesh hull_copy = hull;
  EXPECT_EQ(geometryKey(&hull), geometryKey(&hull_copy));
  EXPECT_NE(geometryKey(&hull), geometryKey(&other));
  EXPECT_NE(geometryKey(static_cast<const ConvexMesh*>(nullptr)),
            geometryKey(static_cast<const LargeMesh*>(nullptr)));
}

}  // namespace
}  // namespace pfx
