// Triangles for drawing: normals, feature edges, and bad input.
#include "viewer/draw_list/mesh_data.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace viewer {
namespace {

using pfx::Vec3;

int featureEdges(const MeshData& mesh) {
  int count = 0;
  for (size_t t = 0; t + 2 < mesh.vertices.size(); t += 3)
    for (int e = 0; e < 3; ++e)
      count += mesh.vertices[t].edge[e] < kPlainEdge && mesh.vertices[t + 1].edge[e] < kPlainEdge;
  return count;
}

double signedVolume(const MeshData& mesh) {
  double volume = 0.0;
  for (size_t t = 0; t + 2 < mesh.vertices.size(); t += 3)
    volume += double(mesh.vertices[t].position.dot(
                  mesh.vertices[t + 1].position.cross(mesh.vertices[t + 2].position))) /
              6.0;
  return volume;
}

TEST(MeshData, TheUnitBoxFacesOutwardsAndShowsEachEdgeFromBothSidesButNoDiagonal) {
  const MeshData box = makeUnitBox();
  ASSERT_EQ(box.vertices.size(), 36u);
  EXPECT_DOUBLE_EQ(signedVolume(box), 8.0);
  EXPECT_EQ(box.bounds.halfExtent(), Vec3::Ones());
  EXPECT_EQ(featureEdges(box), 24);
  for (const MeshVertex& v : box.vertices) EXPECT_EQ(v.normal.dot(v.position), 1.0f);
}

TEST(MeshData, TheUnitCylinderIsRoundAlongXAndShowsOnlyItsRims) {
  const MeshData cylinder = makeUnitCylinder();
  // A regular 32-gon of radius 1 has area 16 sin(pi/16); length 2.
  EXPECT_NEAR(signedVolume(cylinder), 2.0 * 16.0 * std::sin(3.14159265358979 / 16.0), 1e-5);
  EXPECT_EQ(featureEdges(cylinder), 2 * 2 * 32);
  for (const MeshVertex& v : cylinder.vertices) {
    const float side = v.normal.tail<2>().dot(v.position.tail<2>());
    // Smooth sides point straight away from the axis, caps along it. 1e-6: rounding of a normalised sum.
    EXPECT_NEAR(std::abs(v.normal.x()) + side, 1.0f, 1e-6f);
  }
}

TEST(MeshData, FlatNeighboursAreSmoothAndAnOpenBorderIsAFeature) {
  const std::array<Vec3, 4> p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, -1), Vec3(0, 0, -1)};
  const std::array<uint32_t, 6> indices = {0, 1, 2, 0, 2, 3};
  const MeshData square = makeMesh(p, indices);
  EXPECT_EQ(featureEdges(square), 4);
  for (const MeshVertex& v : square.vertices) EXPECT_EQ(v.normal, Vec3::UnitY());
}

TEST(MeshData, NeighboursAreFoundByPlaceNotByIndex) {
  // The same square with each triangle's own vertices.
  const std::array<Vec3, 6> p = {Vec3(0, 0, 0), Vec3(1, 0, 0),  Vec3(1, 0, -1),
                                 Vec3(0, 0, 0), Vec3(1, 0, -1), Vec3(0, 0, -1)};
  const std::array<uint32_t, 6> indices = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(featureEdges(makeMesh(p, indices)), 4);
}

TEST(MeshData, BadTrianglesAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<Vec3, 4> p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(nan, 0, 0)};
  const std::array<uint32_t, 13> indices = {
      0, 1, 2, /* flat */ 0, 1, 1, /* out of range */ 0, 1, 9, /* not finite */ 0, 1, 3, /* rest */ 0};
  EXPECT_EQ(makeMesh(p, indices).vertices.size(), 3u);
  EXPECT_TRUE(makeMesh({}, {}).vertices.empty());
}

}  // namespace
}  // namespace viewer
