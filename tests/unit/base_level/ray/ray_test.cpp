// Rays against each shape: closed forms, brute force over all triangles, and the rules for ends and sides.
#include "pfx/base_level/ray/ray.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pfx/base_level/ray/mesh_ray.h"
#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;

struct Random {
  uint64_t state = 7;
  double next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
  Vec3d vector(double size) {
    const double x = next(), y = next(), z = next();
    return size * Vec3d(2 * x - 1, 2 * y - 1, 2 * z - 1);
  }
};

double distanceToSegment(const Vec3d& p, double half_length) {
  return (p - Vec3d(std::clamp(p.x(), -half_length, half_length), 0, 0)).norm();
}

TEST(Ray, hitsOfPrimitivesLieOnTheirSurfacesAndNothingLiesBefore) {
  const Capsule capsule{0.7f, 0.4f};
  const Cylinder cylinder{0.7f, 0.4f};
  const Box box{Vec3(0.5f, 0.8f, 0.3f)};
  Random random;
  int hits = 0;
  // Signed distance-like functions: negative inside.
  const auto check = [&](const auto& shape, auto&& outside) {
    for (int i = 0; i < 20000; ++i) {
      const Vec3d start = random.vector(3.0), direction = random.vector(1.2) - start;
      if (outside(start) < 0.0) continue;
      const ShapeHit hit = castRay({start, direction}, shape);
      const double end = hit.hit ? hit.fraction : 1.0;
      // Positions are computed in doubles from float sizes.
      if (hit.hit) {
        ++hits;
        EXPECT_NEAR(outside(start + end * direction), 0.0, 1e-12);
        EXPECT_LT(direction.dot(hit.normal.cast<double>()), 1e-6);
        EXPECT_NEAR(hit.normal.norm(), 1.0f, 1e-6f);
        // The surface rises along the normal.
        EXPECT_GT(outside(start + end * direction + 1e-4 * hit.normal.cast<double>()), 0.0);
      }
      for (int k = 0; k < 20; ++k) ASSERT_GE(outside(start + (end * k / 20.0) * direction), -1e-12);
    }
  };
  check(Sphere{0.9f}, [](const Vec3d& p) { return p.norm() - double(0.9f); });
  check(box, [&](const Vec3d& p) { return (p.cwiseAbs() - box.half_extent.cast<double>()).maxCoeff(); });
  check(capsule, [&](const Vec3d& p) { return distanceToSegment(p, capsule.half_length) - double(capsule.radius); });
  check(cylinder, [&](const Vec3d& p) {
    return std::max(std::abs(p.x()) - double(cylinder.half_length), std::hypot(p.y(), p.z()) - double(cylinder.radius));
  });
  EXPECT_GT(hits, 8000);
}

TEST(Ray, startsInsideASolidMeetOnlyBackFaces) {
  const LocalRay front{Vec3d::Zero(), Vec3d(4, 0, 0)};
  LocalRay both = front;
  both.facet_mode = FacetMode::Both;
  const Geometry shapes[] = {Sphere{1.0f}, Box{Vec3(1, 1, 1)}, Capsule{0.5f, 0.5f}, Cylinder{1.0f, 0.3f}};
  for (const Geometry& g : shapes) {
    EXPECT_FALSE(castRay(front, g).hit);
    const ShapeHit hit = castRay(both, g);
    ASSERT_TRUE(hit.hit);
    EXPECT_DOUBLE_EQ(hit.fraction, 0.25);
    EXPECT_EQ(hit.normal, Vec3(-1, 0, 0));
  }
}

TEST(Ray, nothingBeyondTheEndIsHitAndTheEndItselfIs) {
  const Sphere sphere{1.0f};
  EXPECT_TRUE(castRay({Vec3d(-3, 0, 0), Vec3d(2, 0, 0)}, sphere).hit);
  EXPECT_FALSE(castRay({Vec3d(-3, 0, 0), Vec3d(1.999999, 0, 0)}, sphere).hit);
  EXPECT_FALSE(castRay({Vec3d(-3, 0, 0), Vec3d(-9, 0, 0)}, sphere).hit);
  EXPECT_FALSE(castRay({Vec3d(-1, 0, 0), Vec3d::Zero()}, sphere).hit) << "a ray without direction";
}

TEST(Ray, keepsItsPrecisionOnTheWayIntoATurnedFarFrame) {
  const Transform pose{Vec3(30000, -20000, 10000), Quat(Eigen::AngleAxisf(0.7f, Vec3(1, 2, 3).normalized()))};
  const RayInput ray{.start = pose.position + Vec3(0, 4, 0), .direction = Vec3(0, -8, 0)};
  const ShapeHit hit = castRay(toLocal(ray, pose), Sphere{1.0f});
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.fraction, 0.375, 1e-9);
}

// Moeller and Trumbore's test in doubles, over every triangle.
struct Brute {
  bool hit = false;
  double t = 1.0;
  uint32_t source = 0;
  double margin = 1.0;  // how far inside the nearest triangle, in barycentric units
};

Brute bruteForce(const LargeMesh& mesh, const LocalRay& ray) {
  Brute best;
  for (uint32_t f = 0; f < mesh.numFacets(); ++f) {
    const auto v = facetVertices(mesh, f);
    const Vec3d a = v[0].cast<double>(), e1 = v[1].cast<double>() - a, e2 = v[2].cast<double>() - a;
    const Vec3d p = ray.direction.cross(e2);
    const double det = e1.dot(p);
    if (det == 0.0 || (det > 0.0 ? ray.facet_mode == FacetMode::BackOnly : ray.facet_mode == FacetMode::FrontOnly)) continue;
    const Vec3d s = ray.start - a, q = s.cross(e1);
    const double u = s.dot(p) / det, w = ray.direction.dot(q) / det, t = e2.dot(q) / det;
    if (u < 0 || w < 0 || u + w > 1 || t < 0 || t > best.t) continue;
    best = {true, t, mesh.source[f], std::min({u, w, 1 - u - w})};
  }
  return best;
}

TEST(Ray, meshHitsAgreeWithBruteForceInEveryTypeAndFacetMode) {
  const auto soup = pfx_test::bumpyGrid(24, 0.25f);
  int compared = 0;
  for (const LargeMeshType type : {LargeMeshType::ExpandedArray, LargeMeshType::QuantizedArray,
                                   LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh}) {
    const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices, {.type = type}).mesh;
    Random random;
    for (int i = 0; i < 3000; ++i) {
      const Vec3d start = random.vector(6.0), end = random.vector(3.0);
      const FacetMode mode = static_cast<FacetMode>(i % 3);
      const LocalRay ray{start, end - start, 1.0, mode};
      const ShapeHit hit = castRay(ray, mesh);
      const Brute brute = bruteForce(mesh, ray);
      if (brute.hit && brute.margin < 1e-5) continue;  // on an edge: either neighbour is right
      ASSERT_EQ(hit.hit, brute.hit);
      if (!hit.hit) continue;
      ++compared;
      ASSERT_EQ(mesh.source[hit.triangle], brute.source);
      EXPECT_NEAR(hit.fraction, brute.t, 1e-10);
      const auto v = facetVertices(mesh, hit.triangle);
      const Vec3 p = v[0] + hit.barycentric.x() * (v[1] - v[0]) + hit.barycentric.y() * (v[2] - v[0]);
      EXPECT_LT((p.cast<double>() - (start + hit.fraction * ray.direction)).norm(), 2e-6);
    }
  }
  EXPECT_GT(compared, 2000);
}

TEST(Ray, kernelsForSse2AndAvx2GiveTheSameBits) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  const auto soup = pfx_test::bumpyGrid(60, 0.25f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  const LargeMesh quantized = buildLargeMesh(soup.vertices, soup.indices, {.type = LargeMeshType::QuantizedBvh}).mesh;
  Random random;
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3d start = random.vector(9.0);
    const LocalRay ray{start, random.vector(6.0) - start, 1.0, FacetMode::Both};
    const MeshRayHit a = traceWith(traceExpandedSse2, mesh, ray), b = traceWith(traceExpandedAvx2, mesh, ray);
    const MeshRayHit c = traceWith(traceQuantizedSse2, quantized, ray), d = traceWith(traceQuantizedAvx2, quantized, ray);
    ASSERT_EQ(a.facet, b.facet);
    ASSERT_EQ(a.t, b.t);
    ASSERT_EQ(c.facet, d.facet);
    ASSERT_EQ(c.t, d.t);
    hits += a.facet != kNoFacet;
  }
  EXPECT_GT(hits, 1000);
}

TEST(Ray, batchesGiveTheSameBitsAsSingleRays) {
  const auto soup = pfx_test::bumpyGrid(40, 0.25f);
  for (const LargeMeshType type : {LargeMeshType::ExpandedArray, LargeMeshType::QuantizedArray,
                                   LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh}) {
    const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices, {.type = type}).mesh;
    Random random;
    std::vector<LocalRay> rays(333);
    for (LocalRay& ray : rays) {
      ray.start = random.vector(8.0);
      ray.direction = random.vector(6.0) - ray.start;
    }
    std::vector<ShapeHit> hits(rays.size());
    castRays(rays, mesh, hits);
    for (size_t i = 0; i < rays.size(); ++i) {
      const ShapeHit one = castRay(rays[i], mesh);
      ASSERT_EQ(one.hit, hits[i].hit);
      ASSERT_EQ(one.fraction, hits[i].fraction);
      ASSERT_EQ(one.triangle, hits[i].triangle);
      ASSERT_EQ(one.barycentric, hits[i].barycentric);
    }
  }
}

TEST(Ray, meshesFarFromTheOriginAndRaysFromFarAwayAreHit) {
  auto soup = pfx_test::flatGrid(10, 1.0f);
  for (Vec3& v : soup.vertices) v += Vec3(100000, 0, -50000);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  const ShapeHit hit = castRay({Vec3d(100000.3, 90000, -50000.4), Vec3d(0, -100000, 0)}, mesh);
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.fraction, 0.9, 1e-12);
}

TEST(Ray, aRayInThePlaneOfAMeshOrWithoutLengthHitsNothing) {
  const auto soup = pfx_test::flatGrid(4, 1.0f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  EXPECT_FALSE(castRay({Vec3d(-9, 0, 0.1), Vec3d(20, 0, 0), 1.0, FacetMode::Both}, mesh).hit);
  EXPECT_FALSE(castRay({Vec3d(0, 0, 0), Vec3d::Zero(), 1.0, FacetMode::Both}, mesh).hit);
}

}  // namespace
}  // namespace pfx
