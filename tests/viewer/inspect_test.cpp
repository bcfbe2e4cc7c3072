// The facts of the inspectors: triangles, what is on them, and selections that stay the same thing from step to step.
#include <gtest/gtest.h>

#include "pfx/util/mesh_builder/mesh_builder.h"
#include "viewer/inspect/island_facts.h"
#include "viewer/inspect/selection.h"

namespace viewer {
namespace {

using pfx::Vec3;

// A square sheet of n x n squares of 1 m, two triangles each, gently waved.
pfx::LargeMesh sheet(int n, pfx::LargeMeshType type) {
  std::vector<Vec3> points;
  std::vector<uint32_t> indices;
  for (int z = 0; z <= n; ++z)
    for (int x = 0; x <= n; ++x)
      points.push_back(Vec3(float(x) - 0.5f * float(n), 0.1f * float((x * 7 + z * 3) % 4), float(z) - 0.5f * float(n)));
  for (uint32_t z = 0; z < uint32_t(n); ++z)
    for (uint32_t x = 0; x < uint32_t(n); ++x) {
      const uint32_t a = z * uint32_t(n + 1) + x, b = a + uint32_t(n + 1);
      indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  return std::move(pfx::buildLargeMesh(points, indices, {.type = type}).mesh);
}

struct MeshWorld {
  pfx::World world;
  pfx::BodyId ground, ball;
  explicit MeshWorld(pfx::LargeMeshType type = pfx::LargeMeshType::ExpandedBvh) {
    ground = world.addBody({.name = "ground",
                            .pose = {.position = Vec3(1, -2, 3)},
                            .motion_type = pfx::MotionType::Fixed,
                            .shapes = {{world.keep(sheet(12, type))}}});
    ball = world.addBody({.name = "ball",
                          .pose = {.position = Vec3(1.4f, -1.0f, 3.3f)},
                          .shapes = {{pfx::Sphere{0.5f}}},
                          .angular_damping = 1.0f,
                          .rolling_resistance = 0.1f});
  }
};

TEST(MeshFacts, TheHierarchyPathOfEveryTriangleEndsInTheLeafThatHoldsIt) {
  for (const pfx::LargeMeshType type : {pfx::LargeMeshType::ExpandedBvh, pfx::LargeMeshType::QuantizedBvh}) {
    const pfx::LargeMesh mesh = sheet(12, type);
    const auto childOf = [&](const BvhStep& s) {
      return mesh.nodes.empty() ? mesh.quantized_nodes[s.node].child[s.child] : mesh.nodes[s.node].child[s.child];
    };
    for (uint32_t facet = 0; facet < mesh.numFacets(); ++facet) {
      const std::vector<BvhStep> path = bvhPath(mesh, facet);
      ASSERT_FALSE(path.empty());
      EXPECT_EQ(path.front().node, 0u);
      for (size_t i = 1; i < path.size(); ++i) EXPECT_EQ(childOf(path[i - 1]), path[i].node);
      const pfx::MeshChild leaf = childOf(path.back());
      ASSERT_TRUE(pfx::isLeaf(leaf));
      EXPECT_GE(facet, pfx::leafFirst(leaf));
      EXPECT_LT(facet, pfx::leafFirst(leaf) + pfx::leafCount(leaf));
    }
  }
  EXPECT_TRUE(bvhPath(sheet(4, pfx::LargeMeshType::ExpandedArray), 3).empty());
}

TEST(MeshFacts, ARayThroughTheMiddleOfATrianglePicksIt) {
  const MeshWorld w;
  const PlacedMesh placed = *meshOfBody(w.world, w.ground.index);
  for (uint32_t facet = 0; facet < placed.mesh->numFacets(); facet += 17) {
    const auto v = pfx::facetVertices(*placed.mesh, facet);
    const Vec3 middle = placed.pose.apply((v[0] + v[1] + v[2]) / 3.0f);
    for (const float side : {5.0f, -5.0f})
      EXPECT_EQ(pickTriangle(placed, {middle + Vec3(0, side, 0), Vec3(0, -2.0f * side, 0)}), facet);
  }
  EXPECT_EQ(pickTriangle(placed, {Vec3(100, 5, 0), Vec3(0, -10, 0)}), std::nullopt);
  EXPECT_FALSE(meshOfBody(w.world, w.ball.index));
  EXPECT_FALSE(meshOfBody(w.world, 999));
}

TEST(MeshFacts, TheTriangleBelowABallNamesTheBall) {
  MeshWorld w;
  for (int i = 0; i < 240; ++i) w.world.step(1.0f / 60.0f);
  const Vec3 at = w.world.states()[w.ball.index].position;
  const PlacedMesh placed = *meshOfBody(w.world, w.ground.index);
  const Json mesh = toJson(meshFacts(w.world, w.ground.index));
  ASSERT_FALSE(mesh["contacts"].empty());
  for (const Json& contact : mesh["contacts"]) {
    EXPECT_EQ(contact["body"]["name"], "ball");
    const uint32_t facet = contact["triangle"].get<uint32_t>();
    const Json triangle = toJson(triangleFacts(w.world, w.ground.index, facet));
    EXPECT_EQ(triangle["island"], contact["island"]);
    EXPECT_EQ(triangle["contacts"][0]["body"]["index"], w.ball.index);
    const std::vector<uint32_t> touched = touchedTriangles(w.world, w.world.contactPairs().front());
    EXPECT_TRUE(std::binary_search(touched.begin(), touched.end(), facet));
    // The point of contact lies on the triangle, a radius away from the ball (slack: what the ball sank in).
    const Json& p = contact["position"];
    const Vec3 point(p[0].get<float>(), p[1].get<float>(), p[2].get<float>());
    EXPECT_NEAR((point - at).norm(), 0.5f, 0.02f);
    const pfx::MeshTriangle t = pfx::meshTriangle(*placed.mesh, facet);
    EXPECT_NEAR((point - placed.pose.apply(t.vertex[0])).dot(t.normal), 0.0f, 1e-4f);
  }
}

TEST(MeshFacts, OnlyAQuantizedMeshHasAQuantizationErrorAndCornersStayWithinIt) {
  const pfx::LargeMesh exact = sheet(12, pfx::LargeMeshType::ExpandedBvh);
  const MeshWorld plain, coarse(pfx::LargeMeshType::QuantizedBvh);
  EXPECT_EQ(toJson(meshFacts(plain.world, plain.ground.index))["quantization_error"], 0.0);
  const double limit = toJson(meshFacts(coarse.world, coarse.ground.index))["quantization_error"].get<double>();
  EXPECT_GT(limit, 0.0);
  const pfx::LargeMesh& mesh = *meshOfBody(coarse.world, coarse.ground.index)->mesh;
  for (uint32_t facet = 0; facet < mesh.numFacets(); ++facet) {
    const auto near = pfx::facetVertices(mesh, facet), given = pfx::facetVertices(exact, facet);
    // Rounding of coordinates up to 6 m to float: 2^-22.
    for (size_t k = 0; k < 3; ++k) EXPECT_LE(double((near[k] - given[k]).norm()), limit + 5e-7);
  }
}

TEST(Selection, StaysTheSameThingWhilePairsAreNumberedAnew) {
  MeshWorld w;
  for (int i = 0; i < 60; ++i) w.world.step(1.0f / 60.0f);
  const auto pair = findPair(w.world, w.ball.index, w.ground.index);
  ASSERT_TRUE(pair);
  const Selection contact = selectContact(w.world, w.world.contactPairs()[*pair]);
  EXPECT_EQ(titleOf(w.world, contact), "ground on ball");
  // A body with a lower index in another pair takes its place in the list.
  const pfx::BodyId other = w.world.addBody(
      {.name = "second", .pose = {.position = Vec3(-2, -1.2f, 1)}, .shapes = {{pfx::Sphere{0.5f}}}});
  for (int i = 0; i < 60; ++i) w.world.step(1.0f / 60.0f);
  EXPECT_EQ(stillThere(w.world, contact), contact);
  EXPECT_EQ(toJson(factsOf(w.world, contact))["body_b"]["name"], "ball");
  const Selection body = selectBody(w.world, other.index);
  w.world.removeBody(other);
  EXPECT_EQ(stillThere(w.world, body).kind, PickKind::Nothing);
}

TEST(Selection, EveryKindHasATitleFactsAndAPlace) {
  MeshWorld w;
  w.world.addJoint({.name = "hook", .body_a = w.ground, .body_b = w.ball});
  for (int i = 0; i < 60; ++i) w.world.step(1.0f / 60.0f);
  for (const Selection& s :
       {selectBody(w.world, w.ball.index), selectTriangle(w.world, w.ground.index, 5), selectJoint(w.world, 0)}) {
    EXPECT_FALSE(titleOf(w.world, s).empty());
    EXPECT_FALSE(factsOf(w.world, s).facts.empty());
    EXPECT_FALSE(toText(factsOf(w.world, s)).empty());
    const pfx::Aabb box = boundsOf(w.world, s);
    EXPECT_LE(box.min.x(), box.max.x());
  }
  ASSERT_EQ(w.world.numIslands(), 1u);
  const Selection island = selectIsland(w.world, 0);
  EXPECT_EQ(bodiesOf(w.world, island), std::vector<uint32_t>{w.ball.index});
  EXPECT_EQ(islandJson(w.world, 0)["joint_list"].size(), 1u);
}

TEST(IslandFacts, TellWhichBodyKeepsAStackAwake) {
  pfx::World world({.sleeping = true});
  world.addBody({.name = "ground",
                 .pose = {.position = Vec3(0, -1, 0)},
                 .motion_type = pfx::MotionType::Fixed,
                 .shapes = {{pfx::Box{Vec3(9, 1, 9)}}}});
  world.addBody({.name = "low", .pose = {.position = Vec3(0, 0.5f, 0)}, .shapes = {{pfx::Box{Vec3::Constant(0.5f)}}}});
  const pfx::BodyId top = world.addBody(
      {.name = "top", .pose = {.position = Vec3(0, 1.5f, 0)}, .shapes = {{pfx::Box{Vec3::Constant(0.5f)}}}});
  for (int i = 0; i < 30; ++i) world.step(1.0f / 60.0f);
  EXPECT_NE(explainSleep(world, 0).why.find("has been slow for"), std::string::npos);
  world.state(top).can_sleep = false;
  EXPECT_EQ(explainSleep(world, 0).why, "awake: top #2 may not sleep");
  for (int i = 0; i < 10; ++i) world.step(1.0f / 60.0f);
  EXPECT_EQ(world.states()[1].sleep_count, 10u);
  EXPECT_EQ(world.island(0).sleep_timer, 0.0f) << "of the body that keeps it awake, not of the first one";
  world.state(top).can_sleep = true;
  world.state(top).angular_velocity = Vec3(0, 2, 0);
  EXPECT_NE(explainSleep(world, 0).why.find("top #2 moves with"), std::string::npos);
}

}  // namespace
}  // namespace viewer
