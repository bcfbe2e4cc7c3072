// Contacts with large meshes: closed forms, no ghosts at inner edges, no cap, the same in all four types.
#include "pfx/base_level/collision/mesh_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

constexpr LargeMeshType kTypes[] = {LargeMeshType::ExpandedArray, LargeMeshType::QuantizedArray,
                                    LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh};

LargeMesh build(const pfx_test::Soup& soup, LargeMeshType type = LargeMeshType::ExpandedBvh) {
  LargeMeshResult r = buildLargeMesh(soup.vertices, soup.indices, {.type = type});
  EXPECT_EQ(r.error, Error::Ok);
  return std::move(r.mesh);
}

Vector<ContactManifold> collide(const LargeMesh& mesh, const Geometry& body, const Transform& pose,
                                     float margin = 0.01f) {
  MeshContactScratch scratch;
  Vector<ContactManifold> out;
  const Shape ground{&mesh, {}}, shape{body, {}};
  collideMesh({ground, Transform{}, shape, pose, margin}, scratch, out);
  return out;
}

Quat turn(float angle, const Vec3& axis) { return Quat(Eigen::AngleAxisf(angle, axis.normalized())); }
const Quat kUpright = turn(1.57079633f, Vec3::UnitZ());  // local X to world Y

const Geometry kPrimitives[] = {Sphere{0.3f}, Box{Vec3(0.3f, 0.3f, 0.3f)}, Capsule{0.25f, 0.3f}, Cylinder{0.25f, 0.3f}};

TEST(MeshContact, bodiesOnATriangulatedPlaneGetTheExactVerticalNormalEverywhere) {
  const LargeMesh mesh = build(pfx_test::flatGrid(40, 0.1f));
  uint32_t random = 1;
  const auto next = [&] { return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) / 16777216.0f; };
  for (const Geometry& body : kPrimitives) {
    for (int i = 0; i < 500; ++i) {
      const float x = next(), z = next(), depth = next(), angle = next();
      // Lying on the floor, 2 mm deep to 3 mm above, turned about the vertical.
      const Transform pose{Vec3(2 * x - 1, 0.3f - 0.002f + 0.005f * depth, 2 * z - 1), turn(6.0f * angle, Vec3::UnitY())};
      const auto manifolds = collide(mesh, body, pose);
      ASSERT_EQ(manifolds.size(), 1u) << body.index() << " " << i;
      EXPECT_EQ(manifolds[0].normal, Vec3::UnitY());
      for (int k = 0; k < manifolds[0].num_points; ++k) {
        // Heights are sums of a few floats near 0.3.
        EXPECT_NEAR(manifolds[0].points[k].distance, pose.position.y() - 0.3f, 2e-7f);
      }
    }
  }
}

TEST(MeshContact, fastSpeculativeBodiesSeeNoGhostEdgesAhead) {
  const LargeMesh mesh = build(pfx_test::flatGrid(40, 0.1f));
  for (const Geometry& body : kPrimitives) {
    for (int i = 0; i < 50; ++i) {
      const Transform pose{Vec3(-1.0f + 0.037f * float(i), 0.2999f, 0.013f * float(i)), Quat::Identity()};
      for (const ContactManifold& m : collide(mesh, body, pose, 0.33f)) EXPECT_EQ(m.normal, Vec3::UnitY());
    }
  }
}

TEST(MeshContact, sphereMeetsFaceEdgeAndVertexOfAConvexMeshAlongTheLineToItsCentre) {
  pfx_test::Soup cube;
  for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2 & 1));
  cube.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  for (const LargeMeshType type : kTypes) {
    const LargeMesh mesh = build(cube, type);
    for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, -1), Vec3(1, 1, 1), Vec3(-1, 2, 1)}) {
      const Vec3 n = direction.normalized();
      const Vec3 corner = Vec3(0.5f, 0.5f, 0.5f) + 0.5f * n.cwiseSign();
      const auto manifolds = collide(mesh, Sphere{0.25f}, {corner + 0.249f * n, Quat::Identity()});
      ASSERT_EQ(manifolds.size(), 1u) << direction.transpose();
      ASSERT_EQ(manifolds[0].num_points, 1);
      EXPECT_LT((manifolds[0].normal - n).norm(), isQuantized(type) ? 1e-3f : 1e-5f);
      EXPECT_NEAR(manifolds[0].points[0].distance, -0.001f, 1e-5f);
    }
  }
}

TEST(MeshContact, boxAcrossARidgeTakesTheNormalOfItsOwnFace) {
  // A roof with slopes of 30 degrees; the box lies flat on the ridge.
  const float h = std::tan(0.5235988f);
  const std::vector<Vec3> v = {{-1, -h, -2}, {-1, -h, 2}, {0, 0, -2}, {0, 0, 2}, {1, -h, -2}, {1, -h, 2}};
  const LargeMesh mesh =
      buildLargeMesh(v, std::vector<uint32_t>{0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}).mesh;
  const auto manifolds = collide(mesh, Box{Vec3(0.3f, 0.3f, 0.3f)}, {Vec3(0.05f, 0.299f, 0), Quat::Identity()});
  ASSERT_EQ(manifolds.size(), 1u);
  EXPECT_LT((manifolds[0].normal - Vec3::UnitY()).norm(), 1e-6f);
  ASSERT_EQ(manifolds[0].num_points, 2) << "the two ends of the ridge under the box";
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::abs(manifolds[0].points[k].local_a.z()), 0.3f, 1e-5f);
    EXPECT_NEAR(manifolds[0].points[k].distance, -0.001f, 1e-5f);
  }
}

TEST(MeshContact, edgeOfABoxAcrossARidgeMeetsItInOnePoint) {
  const std::vector<Vec3> v = {{-1, -1, -2}, {-1, -1, 2}, {0, 0, -2}, {0, 0, 2}, {1, -1, -2}, {1, -1, 2}};
  const LargeMesh mesh =
      buildLargeMesh(v, std::vector<uint32_t>{0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}).mesh;
  // Standing on an edge that runs along x, across the ridge along z.
  const float diagonal = 0.3f * std::sqrt(2.0f);
  const Transform pose{Vec3(0.1f, diagonal - 0.001f, 0.2f), turn(0.78539816f, Vec3::UnitX())};
  const auto manifolds = collide(mesh, Box{Vec3(0.3f, 0.3f, 0.3f)}, pose);
  ASSERT_EQ(manifolds.size(), 1u);
  EXPECT_LT((manifolds[0].normal - Vec3::UnitY()).norm(), 1e-5f);
  ASSERT_EQ(manifolds[0].num_points, 1);
  EXPECT_LT((manifolds[0].points[0].local_a - Vec3(0, 0, 0.2f)).norm(), 1e-5f);
}

TEST(MeshContact, boxInAConcaveCornerTouchesFloorAndWall) {
  const std::vector<Vec3> v = {{0, 0, -2}, {0, 0, 2}, {2, 0, -2}, {2, 0, 2}, {0, 2, -2}, {0, 2, 2}};
  const LargeMesh mesh =
      buildLargeMesh(v, std::vector<uint32_t>{0, 1, 3, 0, 3, 2, 4, 5, 1, 4, 1, 0}).mesh;
  const auto manifolds =
      collide(mesh, Box{Vec3(0.3f, 0.3f, 0.3f)}, {Vec3(0.299f, 0.2995f, 0), Quat::Identity()});
  ASSERT_EQ(manifolds.size(), 2u);
  for (const ContactManifold& m : manifolds) {
    EXPECT_EQ(m.num_points, 4);
    const bool floor = m.normal.y() > 0.5f;
    EXPECT_EQ(m.normal, floor ? Vec3(0, 1, 0) : Vec3(1, 0, 0));
    EXPECT_NEAR(m.points[0].distance, floor ? -0.0005f : -0.001f, 1e-6f);
  }
  EXPECT_NE(manifolds[0].points[0].feature, manifolds[1].points[0].feature);
}

TEST(MeshContact, slabOver50000TrianglesTouchesAtItsTrueCorners) {
  const auto soup = pfx_test::flatGrid(240, 0.1f);
  for (const LargeMeshType type : {LargeMeshType::ExpandedBvh, LargeMeshType::QuantizedBvh}) {
    const LargeMesh mesh = build(soup, type);
    const Vec3 half(8.03f, 0.5f, 8.01f);  // over 51,000 triangles
    for (const float angle : {0.0f, 0.3f}) {
      const Quat q = turn(angle, Vec3::UnitY());
      const auto manifolds = collide(mesh, Box{half}, {Vec3(0.02f, 0.499f, -0.01f), q});
      ASSERT_EQ(manifolds.size(), 1u);
      ASSERT_EQ(manifolds[0].num_points, 4);
      for (int k = 0; k < 4; ++k) {
        const Vec3& p = manifolds[0].points[k].local_b;
        EXPECT_NEAR(std::abs(p.x()), half.x(), 1e-4f);
        EXPECT_NEAR(std::abs(p.z()), half.z(), 1e-4f);
        EXPECT_NEAR(manifolds[0].points[k].distance, -0.001f, 1e-6f);
      }
    }
  }
}

TEST(MeshContact, facetsHaveOneFrontAndAThickness) {
  const LargeMesh mesh = build(pfx_test::flatGrid(10, 0.5f));
  const auto at = [&](float y) { return collide(mesh, Sphere{0.1f}, {Vec3(0.11f, y, 0.07f), Quat::Identity()}); };
  ASSERT_EQ(at(-0.02f).size(), 1u) << "the centre is behind the front, inside the thickness of 25 mm";
  EXPECT_EQ(at(-0.02f)[0].normal, Vec3::UnitY());
  EXPECT_NEAR(at(-0.02f)[0].points[0].distance, -0.12f, 1e-6f);
  EXPECT_TRUE(at(-0.03f).empty()) << "on the other side: not the facet's concern";
}

TEST(MeshContact, aPointBehindAConcaveEdgeIsInsideTheThicknessOfOneOfItsFacets) {
  // A valley of 90 degrees; without leaning sides there would be a gap below its line.
  const std::vector<Vec3> v = {{-1, 1, -2}, {-1, 1, 2}, {0, 0, -2}, {0, 0, 2}, {1, 1, -2}, {1, 1, 2}};
  const LargeMesh mesh =
      buildLargeMesh(v, std::vector<uint32_t>{0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}).mesh;
  for (const float x : {-0.01f, -0.001f, 0.0f, 0.001f, 0.01f}) {
    EXPECT_FALSE(collide(mesh, Sphere{0.1f}, {Vec3(x, -0.015f, 0.3f), Quat::Identity()}).empty()) << x;
  }
}

TEST(MeshContact, pointsLieOnBothSurfacesAndNameTheirTriangle) {
  const LargeMesh mesh = build(pfx_test::bumpyGrid(60, 0.25f));
  int points = 0;
  for (int i = 0; i < 300; ++i) {
    const float x = -6.0f + 0.04f * float(i), z = 3.0f * std::sin(0.1f * float(i));
    const float ground = std::sin(0.31f * x) * std::cos(0.27f * z) + 0.5f * std::sin(1.3f * x + 0.7f * z);
    const Transform pose{Vec3(x, ground + 0.31f, z), turn(0.3f * float(i), Vec3(1, 2, 0.5f))};
    for (const Geometry& body : kPrimitives) {
      for (const ContactManifold& m : collide(mesh, body, pose, 0.02f)) {
        EXPECT_NEAR(m.normal.norm(), 1.0f, 1e-5f);
        for (int k = 0; k < m.num_points; ++k) {
          const ContactPoint& p = m.points[k];
          ++points;
          // On the triangle at (s, t).
          const auto v = facetVertices(mesh, p.triangle);
          const Vec3 q = v[0] + p.barycentric.x() * (v[1] - v[0]) + p.barycentric.y() * (v[2] - v[0]);
          EXPECT_LT((q - p.local_a).norm(), 1e-4f) << body.index() << " " << i;
          // The points are `distance` apart along the normal of their facet, within the degree that a cluster spans.
          const Vec3 gap = pose.apply(p.local_b) - p.local_a;
          EXPECT_NEAR(gap.dot(m.normal), p.distance, 2e-4f * std::abs(p.distance) + 1e-5f) << body.index() << " " << i;
          EXPECT_LE(p.distance, 0.02f);
        }
      }
    }
  }
  EXPECT_GT(points, 1000);
}

TEST(MeshContact, allTypesGiveTheSameContacts) {
  const auto soup = pfx_test::bumpyGrid(40, 0.25f);
  const LargeMesh reference = build(soup, LargeMeshType::ExpandedArray), bvh = build(soup, LargeMeshType::ExpandedBvh);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const float x = -3.0f + 0.06f * float(i), z = 0.5f;
    const float ground = std::sin(0.31f * x) * std::cos(0.27f * z) + 0.5f * std::sin(1.3f * x + 0.7f * z);
    const Transform pose{Vec3(x, ground + 0.29f, z), turn(0.3f * float(i), Vec3(1, 2, 0.5f))};
    for (const Geometry& body : kPrimitives) {
      const auto a = collide(reference, body, pose), b = collide(bvh, body, pose);
      const auto deepest = [](const Vector<ContactManifold>& manifolds) {
        float d = 1.0f;
        for (const ContactManifold& m : manifolds) {
          for (int k = 0; k < m.num_points; ++k) d = std::min(d, m.points[k].distance);
        }
        return d;
      };
      // Depths within 1e-4 of the size count as equal when points are chosen.
      EXPECT_NEAR(deepest(a), deepest(b), 1e-4f * 0.52f);
      compared += !a.empty();
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(MeshContact, swappedPairGivesTheMirroredManifold) {
  const LargeMesh mesh = build(pfx_test::flatGrid(10, 0.5f));
  const Shape ground{&mesh, {Vec3(0, 1, 0), turn(0.2f, Vec3::UnitX())}}, box{Box{Vec3(0.3f, 0.3f, 0.3f)}, {Vec3(0.1f, 0, 0), turn(0.2f, Vec3::UnitX())}};
  const Transform ground_pose{Vec3(5, 2, 1), Quat::Identity()};
  const Transform box_pose{ground_pose.position + ground.offset.apply(Vec3(0, 0.299f, 0)), Quat::Identity()};
  MeshContactScratch scratch;
  Vector<ContactManifold> ab, ba;
  EXPECT_EQ(collideMesh({ground, ground_pose, box, box_pose, 0.01f}, scratch, ab), 1);
  EXPECT_EQ(collideMesh({box, box_pose, ground, ground_pose, 0.01f}, scratch, ba), 1);
  ASSERT_EQ(ab.size(), 1u);
  ASSERT_EQ(ba.size(), 1u);
  EXPECT_LT((ab[0].normal + ba[0].normal).norm(), 1e-6f);
  EXPECT_LT((ba[0].local_normal - box_pose.orientation.conjugate() * ba[0].normal).norm(), 1e-6f);
  for (int k = 0; k < 4; ++k) {
    EXPECT_LT((ab[0].points[k].local_a - ba[0].points[k].local_b).norm(), 1e-5f);
    const Vec3 a = ground_pose.apply(ab[0].points[k].local_a), b = box_pose.apply(ab[0].points[k].local_b);
    EXPECT_NEAR((b - a).dot(ab[0].normal), ab[0].points[k].distance, 1e-5f);
  }
}

TEST(MeshContact, ballRollingOffAnOpenRimTurnsItsNormalOutwards) {
  const LargeMesh mesh = build(pfx_test::flatGrid(4, 0.5f));  // x in -1 .. 1
  const Vec3 n = Vec3(1, 1, 0).normalized();
  const auto manifolds = collide(mesh, Sphere{0.2f}, {Vec3(1, 0, 0.1f) + 0.199f * n, Quat::Identity()});
  ASSERT_EQ(manifolds.size(), 1u);
  EXPECT_LT((manifolds[0].normal - n).norm(), 1e-5f);
}

}  // namespace
}  // namespace pfx
