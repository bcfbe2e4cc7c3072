// The four-point rule: the deepest stays, the area is the largest, and the choice is steady.
#include "pfx/base_level/collision/contact_reduction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/base_level/collision/collide_test.h"

namespace pfx {
namespace {

using namespace test;

LocalContact at(float x, float z, float distance, uint32_t feature) {
  return {Vec3(x, 0, z), Vec3(x, distance, z), distance, feature};
}

LocalManifold reduce(const std::vector<LocalContact>& candidates) {
  LocalManifold m;
  m.normal = Vec3::UnitY();
  reduceContacts(candidates, m);
  return m;
}

bool has(const LocalManifold& m, uint32_t feature) {
  return std::any_of(m.points.begin(), m.points.begin() + m.num_points,
                     [&](const LocalContact& c) { return c.feature == feature; });
}

// Area of the convex hull of the kept points (gift wrapping over four points: the largest of the triangle
// sums).
float area(const LocalManifold& m) {
  const auto cross = [&](int a, int b, int c) {
    const Vec3 u = m.points[b].point_a - m.points[a].point_a, v = m.points[c].point_a - m.points[a].point_a;
    return std::abs(u.cross(v).y()) / 2.0f;
  };
  const float t0 = cross(0, 1, 2), t1 = cross(0, 1, 3), t2 = cross(0, 2, 3), t3 = cross(1, 2, 3);
  return std::max(0.5f * (t0 + t1 + t2 + t3), std::max({t0, t1, t2, t3}));
}

TEST(ContactReduction, UpToFourPointsAreAllKept) {
  for (int n = 0; n <= 4; ++n) {
    std::vector<LocalContact> candidates;
    for (int i = 0; i < n; ++i) candidates.push_back(at(float(i), 0.0f, 0.0f, uint32_t(i)));
    EXPECT_EQ(reduce(candidates).num_points, n);
  }
}

TEST(ContactReduction, TheDeepestOfRandomPointsIsAlwaysKept) {
  Random random(41);
  for (int k = 0; k < 2000; ++k) {
    std::vector<LocalContact> candidates;
    const int count = 5 + k % 30;
    for (int i = 0; i < count; ++i) {
      const float x = random.uniform(-1.0f, 1.0f), z = random.uniform(-1.0f, 1.0f),
                  d = random.uniform(-0.1f, 0.0f);
      candidates.push_back(at(x, z, d, uint32_t(i)));
    }
    const auto deepest = std::min_element(
        candidates.begin(), candidates.end(),
        [](const LocalContact& a, const LocalContact& b) { return a.distance < b.distance; });
    const LocalManifold m = reduce(candidates);
    EXPECT_EQ(m.num_points, 4);
    EXPECT_TRUE(has(m, deepest->feature));
  }
}

TEST(ContactReduction, OfARectangleWithInnerPointsTheCornersAreKept) {
  std::vector<LocalContact> candidates{at(0.2f, 0.1f, 0, 0), at(-1, -1, 0, 1), at(0, 0, 0, 2),
                                       at(1, -1, 0, 3),      at(1, 1, 0, 4),   at(0, 1, 0, 5),
                                       at(-1, 1, 0, 6)};
  const LocalManifold m = reduce(candidates);
  for (const uint32_t corner : {1u, 3u, 4u, 6u}) EXPECT_TRUE(has(m, corner));
}

TEST(ContactReduction, RegularPolygonsKeepNearlyTheLargestArea) {
  for (const int sides : {6, 8, 12, 16, 64, 200}) {
    std::vector<LocalContact> candidates;
    for (int i = 0; i < sides; ++i) {
      const float angle = 0.1f + 6.28318531f * float(i) / float(sides);
      candidates.push_back(at(std::cos(angle), std::sin(angle), 0.0f, uint32_t(i)));
    }
    const float best =
        sides == 6 ? 1.7320508f : 2.0f;  // of four corners of a hexagon; of a square in the circle
    EXPECT_GT(area(reduce(candidates)), 0.9f * best);
  }
}

TEST(ContactReduction, RoundingOfDepthsDoesNotChangeTheChoice) {
  Random random(43);
  std::vector<LocalContact> octagon;
  for (int i = 0; i < 8; ++i) {
    const float angle = 0.785398163f * float(i);
    octagon.push_back(at(std::cos(angle), std::sin(angle), 0.0f, uint32_t(i)));
  }
  const LocalManifold first = reduce(octagon);
  for (int k = 0; k < 100; ++k) {
    std::vector<LocalContact> noisy = octagon;
    for (LocalContact& c : noisy) {
      c.distance += random.uniform(-1e-5f, 1e-5f);
      c.point_b.x() += random.uniform(-1e-4f, 1e-4f);
    }
    const LocalManifold m = reduce(noisy);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(has(first, m.points[i].feature));
  }
}

}  // namespace
}  // namespace pfx
