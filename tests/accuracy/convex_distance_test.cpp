// ACC-31: signed distances of convex hulls against exact rational arithmetic
// (tests/accuracy/ref/convex.json).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/shape/convex_hull.h"

namespace pfx {
namespace {

std::vector<Vec3> points(const nlohmann::json& list) {
  std::vector<Vec3> out;
  for (const auto& p : list) out.emplace_back(p[0].get<float>(), p[1].get<float>(), p[2].get<float>());
  return out;
}

struct Row {
  ConvexMesh a, b;
  double distance = 0.0;
  Vec3 axis = Vec3::Zero();
};

std::vector<Row> table() {
  std::ifstream file(std::filesystem::path(VITRINE_SOURCE_DIR) / "tests/accuracy/ref/convex.json");
  const nlohmann::json json = nlohmann::json::parse(file);
  std::vector<Row> rows;
  for (const auto& pair : json["pairs"]) {
    Row& row = rows.emplace_back();
    EXPECT_EQ(buildConvexMesh(points(pair["a"]), row.a), Error::Ok);
    EXPECT_EQ(buildConvexMesh(points(pair["b"]), row.b), Error::Ok);
    row.distance = pair["signed_distance"].get<double>();
    if (const auto& axis = pair["axis_if_penetrating"]; !axis.is_null())
      row.axis = Vec3(axis[0].get<float>(), axis[1].get<float>(), axis[2].get<float>());
  }
  return rows;
}

constexpr double kSize = 4.0;  // m, extent of the hulls
constexpr double kTolerance = 1e-5 * kSize;

TEST(ConvexDistance, EveryHullPairOfTheExactTableHasItsSignedDistance) {
  double worst = 0.0;
  int overlapping = 0;
  for (const Row& row : table()) {
    const Shape a{&row.a, {}}, b{&row.b, {}};
    ContactManifold m;
    ASSERT_GT(collideShapes({a, Transform{}, b, Transform{}, 10.0f}, m), 0);
    double deepest = 1e30;
    for (int i = 0; i < m.num_points; ++i) deepest = std::min(deepest, double(m.points[i].distance));
    EXPECT_NEAR(deepest, row.distance, kTolerance);
    worst = std::max(worst, std::abs(deepest - row.distance));
    if (row.distance < 0.0) {
      ++overlapping;
      EXPECT_NEAR(std::abs(m.normal.dot(row.axis)), 1.0f, 1e-5f);
    }
  }
  EXPECT_EQ(overlapping, 37);
  std::printf("  ACC-31 signed distance of 60 hull pairs, worst %.1e m (limit %.0e)\n", worst, kTolerance);
}

TEST(ConvexDistance, TheDistanceQueryAgreesWhereTheHullsAreApart) {
  int apart = 0;
  for (const Row& row : table()) {
    const Polytope a = row.a.view(), b = row.b.view();
    const ConvexCore core_a = polytopeCore(a), core_b = polytopeCore(b);
    const GjkResult gjk = gjkDistance({core_a, core_b, RelativePose{}});
    EXPECT_EQ(gjk.state == GjkResult::State::Separated, row.distance > 0.0);
    if (row.distance < 0.0) continue;
    ++apart;
    EXPECT_NEAR(double(gjk.distance), row.distance, kTolerance);
    EXPECT_NEAR(double((gjk.point_b - gjk.point_a).norm()), row.distance, kTolerance);
  }
  EXPECT_EQ(apart, 23);
}

}  // namespace
}  // namespace pfx
