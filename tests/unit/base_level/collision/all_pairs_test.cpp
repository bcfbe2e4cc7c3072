// Every pair of convex shapes against an oracle that knows only support functions: the signed distance is the
// largest separation over all directions.
#include <array>
#include <cmath>

#include "pfx/base_level/collision/overlap_descent.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

constexpr std::array kConvexTypes{ShapeType::Sphere, ShapeType::Box, ShapeType::Capsule, ShapeType::Cylinder,
                                  ShapeType::ConvexMesh};
constexpr const char* kNames[] = {"sphere", "box", "capsule", "cylinder", "convex"};

// A shape with the data that the oracle needs.
struct Solid {
  Shape shape;
  ConvexMesh mesh;
  Polytope polytope;
  ConvexCore core;
  float inner_radius = 0.0f;
  Vec3 center = Vec3::Zero();  // of the inner ball

  Solid(ShapeType type, Random& random) {
    const float a = random.uniform(0.2f, 1.0f), b = random.uniform(0.2f, 1.0f),
                c = random.uniform(0.2f, 1.0f);
    inner_radius = std::min(a, b);
    if (type == ShapeType::Sphere) shape.geometry = Sphere{a}, core = pointCore(a), inner_radius = a;
    if (type == ShapeType::Box) {
      const Box box{Vec3(a, b, c)};
      shape.geometry = box, core = boxCore(box), inner_radius = std::min({a, b, c});
    }
    if (type == ShapeType::Capsule)
      shape.geometry = Capsule{a, b}, core = segmentCore(Capsule{a, b}), inner_radius = b;
    if (type == ShapeType::Cylinder) shape.geometry = Cylinder{a, b}, core = cylinderCore(Cylinder{a, b});
    if (type == ShapeType::ConvexMesh) {
      std::vector<Vec3> points;
      const int count = 6 + int(random.uniform(0.0f, 20.0f));
      for (int i = 0; i < count; ++i) points.push_back(random.direction().cwiseProduct(Vec3(a, b, c)));
      EXPECT_EQ(buildConvexMesh(points, mesh), Error::Ok);
      polytope = mesh.view();
      shape.geometry = &mesh, core = polytopeCore(polytope), inner_radius = mesh.inner_radius,
      center = mesh.centroid;
    }
  }
  Solid(const Solid&) = delete;
};

float separation(const Solid& a, const Solid& b, const RelativePose& pose, const Vec3& n) {
  return separationAlong(a.core, b.core, pose, n) - a.core.radius - b.core.radius;
}

// Largest separation over all directions: a dense grid, then a pattern search from its best ten.
float oracle(const Solid& a, const Solid& b, const RelativePose& pose) {
  constexpr int kGrid = 4000, kStarts = 12;
  std::array<std::pair<float, Vec3>, kStarts> best;
  best.fill({-1e30f, Vec3::UnitX()});
  for (int i = 0; i < kGrid; ++i) {
    const float z = 1.0f - (2.0f * float(i) + 1.0f) / kGrid, r = std::sqrt(1.0f - z * z),
                angle = 2.39996323f * float(i);
    const Vec3 n(r * std::cos(angle), r * std::sin(angle), z);
    const float s = separation(a, b, pose, n);
    for (auto& slot : best) {
      if (n.dot(slot.second) > 0.995f && s <= slot.first) break;
      if (s > slot.first) {
        slot = {s, n};
        break;
      }
    }
  }
  float result = -1e30f;
  for (auto [s, n] : best) {
    for (float step = 0.05f; step > 2e-6f;) {
      const TangentPair t = tangents(n);
      bool improved = false;
      for (int k = 0; k < 12; ++k) {
        const float angle = 0.5235988f * float(k);
        const Vec3 m = (n + step * (std::cos(angle) * t.t1 + std::sin(angle) * t.t2)).normalized();
        const float value = separation(a, b, pose, m);
        if (value > s) s = value, n = m, improved = true;
      }
      if (!improved) step *= 0.5f;
    }
    result = std::max(result, s);
  }
  return result;
}

class AllPairs : public testing::TestWithParam<std::tuple<ShapeType, ShapeType>> {};

// The oracle's search may stop below the true maximum, never above it; and what a manifold reports must be
// attained by its own normal. Together the two bounds enclose the error.
TEST_P(AllPairs, ReportTheSignedDistanceOfTheOracle) {
  const auto [type_a, type_b] = GetParam();
  Random random(11 + 7 * uint32_t(type_a) + uint32_t(type_b));
  float below[2] = {0.0f, 0.0f}, above[2] = {0.0f, 0.0f};
  for (int i = 0; i < 60; ++i) {
    const Solid a(type_a, random), b(type_b, random);
    const Transform pose_a{random.vector(1.0f), random.rotation()},
        pose_b{random.vector(1.0f), random.rotation()};
    const ContactManifold m = collide(a.shape, pose_a, b.shape, pose_b, 10.0f);
    ASSERT_GT(m.num_points, 0);
    expectConsistent(m, pose_a, pose_b, 1e-5f);
    const RelativePose pose(relative(pose_a, pose_b));
    const float expected = oracle(a, b, pose), found = deepest(m);
    const float attained = separation(a, b, pose, pose_a.orientation.conjugate() * m.normal);
    const int overlap = expected < 0.0f;
    below[overlap] = std::max(below[overlap], expected - found);
    above[overlap] = std::max(above[overlap], found - attained);
  }
  EXPECT_LT(std::max(below[0], above[0]), 2e-5f);
  EXPECT_LT(std::max(below[1], above[1]), 2e-5f);
}

TEST_P(AllPairs, NeverMissAnOverlapOfTheInscribedBalls) {
  const auto [type_a, type_b] = GetParam();
  Random random(101 + 7 * uint32_t(type_a) + uint32_t(type_b));
  int overlapping = 0;
  for (int k = 0; k < 40; ++k) {
    const Solid a(type_a, random), b(type_b, random);
    for (int i = 0; i < 100; ++i) {
      const Transform pose_a{random.vector(0.5f), random.rotation()},
          pose_b{random.vector(0.5f), random.rotation()};
      const float gap =
          (pose_a.apply(a.center) - pose_b.apply(b.center)).norm() - a.inner_radius - b.inner_radius;
      if (gap > -1e-5f) continue;
      ++overlapping;
      const ContactManifold m = collide(a.shape, pose_a, b.shape, pose_b, 0.0f);
      ASSERT_GT(m.num_points, 0);
      EXPECT_LE(deepest(m), gap + 1e-4f);
    }
  }
  EXPECT_GT(overlapping, 100);
}

TEST_P(AllPairs, SwappingTheShapesMirrorsNormalAndDepth) {
  const auto [type_a, type_b] = GetParam();
  Random random(201 + 7 * uint32_t(type_a) + uint32_t(type_b));
  for (int k = 0; k < 200; ++k) {
    const Solid a(type_a, random), b(type_b, random);
    const Transform pose_a{random.vector(0.8f), random.rotation()},
        pose_b{random.vector(0.8f), random.rotation()};
    const ContactManifold ab = collide(a.shape, pose_a, b.shape, pose_b),
                          ba = collide(b.shape, pose_b, a.shape, pose_a);
    ASSERT_EQ(ab.num_points > 0, ba.num_points > 0);
    if (ab.num_points == 0) continue;
    EXPECT_NEAR(deepest(ab), deepest(ba), 5e-5f);
  }
}

std::string pairName(const testing::TestParamInfo<std::tuple<ShapeType, ShapeType>>& pair) {
  return std::string(kNames[int(std::get<0>(pair.param))]) + "_" + kNames[int(std::get<1>(pair.param))];
}

INSTANTIATE_TEST_SUITE_P(Convex, AllPairs,
                         testing::Combine(testing::ValuesIn(kConvexTypes), testing::ValuesIn(kConvexTypes)),
                         pairName);

}  // namespace
}  // namespace pfx
