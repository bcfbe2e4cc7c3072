// Convex meshes: hulls of easy and nasty input, refusal of concave meshes, exact mass properties.
#include "pfx/base_level/shape/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pfx/base_level/rigid_body/mass_properties.h"

namespace pfx {
namespace {

std::vector<Vec3> cubeCorners(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half));
  return corners;
}

// Indices of cubeCorners().
const std::vector<uint32_t> kCubeTriangles{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                           2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

// Closed, consistent, convex: Euler's formula, planes of faces, two faces an edge.
void expectSound(const ConvexMesh& mesh, float tolerance) {
  EXPECT_EQ(mesh.vertices.size() + mesh.faces.size(), mesh.edges.size() + 2);
  const Polytope p = mesh.view();
  for (uint32_t f = 0; f < p.faces.size(); ++f) {
    EXPECT_NEAR(p.planes[f].normal.norm(), 1.0f, 1e-5f);
    for (const Vec3& v : p.vertices) EXPECT_LE(p.planes[f].normal.dot(v) - p.planes[f].offset, tolerance);
    for (uint16_t v : p.face(f))
      EXPECT_NEAR(p.planes[f].normal.dot(p.vertices[v]), p.planes[f].offset, tolerance);
  }
  for (const PolytopeEdge& e : p.edges) EXPECT_NE(e.left, e.right);
}

TEST(ConvexHull, CubeHasSixQuadsTwelveEdgesEightVertices) {
  ConvexMesh mesh;
  ASSERT_EQ(buildConvexMesh(cubeCorners(Vec3(1, 2, 3)), mesh), Error::Ok);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_EQ(mesh.edges.size(), 12u);
  EXPECT_NEAR(mesh.volume, 48.0f, 1e-4f);
  EXPECT_NEAR(mesh.inner_radius, 1.0f, 1e-6f);
  EXPECT_NEAR(mesh.outer_radius, std::sqrt(14.0f), 1e-6f);
  expectSound(mesh, 1e-6f);
}

TEST(ConvexHull, DuplicateInnerEdgeAndFacePointsVanish) {
  std::vector<Vec3> points = cubeCorners(Vec3(1, 1, 1));
  std::mt19937 random(5);
  const auto uniform = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
  for (int i = 0; i < 200; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = uniform();
    if (i % 3 == 0) p[i % 2] = 1.0f;
    if (i % 6 == 0) p[2] = -1.0f;
    points.push_back(p);
  }
  for (int i = 0; i < 8; ++i) points.push_back(points[i]);
  ConvexMesh mesh;
  ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 6u);
}

TEST(ConvexHull, TurnedCubeStillMergesItsFaces) {
  const Quat turn(Eigen::AngleAxisf(0.9f, Vec3(1, 2, 3).normalized()));
  std::vector<Vec3> points = cubeCorners(Vec3(1, 1, 1));
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) points.push_back(Vec3(0.4f * float(i) - 0.8f, 0.4f * float(j) - 0.8f, 1.0f));
  }
  for (Vec3& p : points) p = Vec3(10, 20, 30) + turn * p;
  ConvexMesh mesh;
  ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 6u);
}

TEST(ConvexHull, PointsOnASphereAndPrismsOfManySidesAreSound) {
  for (const int count : {10, 32, 100, 1000}) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const float z = 1.0f - (2.0f * float(i) + 1.0f) / float(count), r = std::sqrt(1.0f - z * z);
      points.push_back(Vec3(r * std::cos(2.39996323f * float(i)), r * std::sin(2.39996323f * float(i)), z));
    }
    ConvexMesh mesh;
    ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok);
    EXPECT_EQ(mesh.vertices.size(), size_t(count));
    expectSound(mesh, 5e-6f);
  }
  for (const int sides : {3, 16, 64, 255}) {
    std::vector<Vec3> points;
    for (int i = 0; i < 2 * sides; ++i) {
      const float angle = 6.28318531f * float(i / 2) / float(sides);
      points.push_back(Vec3(i & 1 ? 1.0f : -1.0f, std::cos(angle), std::sin(angle)));
    }
    ConvexMesh mesh;
    ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok);
    EXPECT_EQ(mesh.faces.size(), size_t(sides) + 2);
    expectSound(mesh, 5e-6f);
  }
}

TEST(ConvexHull, RandomCloudsHoldAllTheirPoints) {
  std::mt19937 random(17);
  const auto uniform = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
  for (int k = 0; k < 300; ++k) {
    // Some clouds snap to a coarse lattice, which makes many coplanar and collinear points.
    const float lattice = k % 3 == 0 ? 4.0f : k % 3 == 1 ? 64.0f : 0.0f;
    const float flat = k % 5 == 0 ? 0.01f : 1.0f;
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
      Vec3 p;
      for (int c = 0; c < 3; ++c)
        p[c] = lattice > 0.0f ? std::round(uniform() * lattice) / lattice : uniform();
      p.y() *= flat;
      points.push_back(p);
    }
    ConvexMesh mesh;
    ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok) << k;
    expectSound(mesh, 1e-5f);
    for (const Plane& plane : mesh.planes) {
      for (const Vec3& p : points) EXPECT_LE(plane.normal.dot(p) - plane.offset, 1e-5f) << k;
    }
  }
}

TEST(ConvexHull, SizeDoesNotMatterFromMillimetresToKilometres) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    std::vector<Vec3> points = cubeCorners(Vec3::Constant(scale));
    points.push_back(Vec3(0, 1.2f * scale, 0));
    ConvexMesh mesh;
    ASSERT_EQ(buildConvexMesh(points, mesh), Error::Ok);
    EXPECT_EQ(mesh.vertices.size(), 9u);
    EXPECT_EQ(mesh.faces.size(), 9u);
  }
}

TEST(ConvexHull, NonsenseIsRefusedWithTheErrorThatNamesIt) {
  ConvexMesh mesh;
  EXPECT_EQ(buildConvexMesh({}, mesh), Error::Degenerate);
  const std::vector<Vec3> same(10, Vec3(1, 2, 3));
  EXPECT_EQ(buildConvexMesh(same, mesh), Error::Degenerate);
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(buildConvexMesh(line, mesh), Error::Degenerate);
  const std::vector<Vec3> plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3f, 0.2f, 0}};
  EXPECT_EQ(buildConvexMesh(plane, mesh), Error::Degenerate);
  std::vector<Vec3> corners = cubeCorners(Vec3(1, 1, 1));
  corners[3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(buildConvexMesh(corners, mesh), Error::InvalidValue);
  EXPECT_TRUE(mesh.vertices.empty());
  std::vector<Vec3> prism;
  for (int i = 0; i < 800; ++i) {
    const float angle = 6.28318531f * float(i / 2) / 400.0f;
    prism.push_back(Vec3(i & 1 ? 1.0f : -1.0f, std::cos(angle), std::sin(angle)));
  }
  EXPECT_EQ(buildConvexMesh(prism, mesh), Error::OutOfRange);
}

TEST(ConvexCheck, CubeIsAcceptedWithEitherWindingAndOpenOrDentedMeshesAreNot) {
  ConvexMesh mesh;
  std::vector<Vec3> corners = cubeCorners(Vec3(1, 1, 1));
  EXPECT_EQ(checkConvexMesh(corners, kCubeTriangles, mesh), Error::Ok);
  std::vector<uint32_t> flipped(kCubeTriangles.rbegin(), kCubeTriangles.rend());
  EXPECT_EQ(checkConvexMesh(corners, flipped, mesh), Error::Ok);
  const std::vector<uint32_t> open(kCubeTriangles.begin(), kCubeTriangles.end() - 3);
  EXPECT_EQ(checkConvexMesh(corners, open, mesh), Error::NotConvex);
  EXPECT_EQ(checkConvexMesh(corners, std::span(kCubeTriangles).first(35), mesh), Error::OutOfRange);
  std::vector<uint32_t> wild = kCubeTriangles;
  wild[7] = 8;
  EXPECT_EQ(checkConvexMesh(corners, wild, mesh), Error::OutOfRange);

  // The last face gets a middle point that is pushed in.
  std::vector<uint32_t> dented(kCubeTriangles.begin(), kCubeTriangles.end() - 6);
  for (const uint32_t edge : {1u, 3u, 7u, 5u}) {
    const uint32_t next = edge == 1 ? 3 : edge == 3 ? 7 : edge == 7 ? 5 : 1;
    dented.insert(dented.end(), {edge, next, 8u});
  }
  corners.push_back(Vec3(0.9f, 0, 0));
  EXPECT_EQ(checkConvexMesh(corners, dented, mesh), Error::NotConvex);
  corners[8].x() = 1.0f;
  EXPECT_EQ(checkConvexMesh(corners, dented, mesh), Error::Ok);
  corners[8].x() = 1.1f;
  EXPECT_EQ(checkConvexMesh(corners, dented, mesh), Error::Ok);
}

TEST(ConvexMassProperties, CubeMeshEqualsTheBoxAndTetrahedronTheClosedForm) {
  ConvexMesh mesh;
  std::vector<Vec3> corners = cubeCorners(Vec3(1, 0.5f, 2));
  for (Vec3& c : corners) c += Vec3(5, -3, 2);
  ASSERT_EQ(buildConvexMesh(corners, mesh), Error::Ok);
  const MassProperties m = massProperties(Geometry(&mesh), 3.0f);
  const MassProperties box = massProperties(Geometry(Box{Vec3(1, 0.5f, 2)}), 3.0f);
  EXPECT_NEAR(m.mass, box.mass, 1e-5f * box.mass);
  EXPECT_NEAR((m.center - Vec3(5, -3, 2)).norm(), 0.0f, 1e-5f);
  EXPECT_LT((m.inertia - box.inertia).norm(), 1e-5f * box.inertia.norm());

  // Corner tetrahedron with legs 1: volume 1/6, centre 1/4, I_xx about the origin 2 / 60, products of inertia
  // 1 / 120.
  const std::vector<Vec3> legs{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  ASSERT_EQ(buildConvexMesh(legs, mesh), Error::Ok);
  EXPECT_NEAR(mesh.volume, 1.0f / 6.0f, 1e-6f);
  EXPECT_NEAR((mesh.centroid - Vec3::Constant(0.25f)).norm(), 0.0f, 1e-6f);
  EXPECT_NEAR(mesh.unit_inertia(0, 0), 1.0f / 30.0f - 2.0f / 6.0f / 16.0f, 1e-6f);
  EXPECT_NEAR(mesh.unit_inertia(0, 1), -1.0f / 120.0f + 1.0f / 6.0f / 16.0f, 1e-6f);
}

}  // namespace
}  // namespace pfx
