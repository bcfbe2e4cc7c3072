// Bounds of shapes and the checks of a collidable.
#include "pfx/base_level/shape/collidable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pfx/base_level/shape/polytope.h"

namespace pfx {
namespace {

const Quat kTurn(Eigen::AngleAxisf(0.6f, Vec3(1, -2, 0.5f).normalized()));

TEST(ShapeAabb, CylinderBoundsTouchTheRim) {
  const Aabb box = shapeAabb(Cylinder{1.0f, 0.5f}, {Vec3(1, 2, 3), kTurn});
  Aabb sampled;
  for (int i = 0; i < 3600; ++i) {
    const float angle = float(i) * 0.00174532925f;
    for (const float x : {-1.0f, 1.0f}) {
      sampled.extend(Vec3(Vec3(1, 2, 3) + kTurn * Vec3(x, 0.5f * std::cos(angle), 0.5f * std::sin(angle))));
    }
  }
  EXPECT_TRUE(box.grown(1e-5f).contains(sampled));
  EXPECT_NEAR((box.max - sampled.max).norm(), 0.0f, 1e-5f);
}

TEST(ShapeAabb, CapsuleBoundsAreThoseOfItsTwoBalls) {
  const Transform pose{Vec3(1, 2, 3), kTurn};
  Aabb balls = shapeAabb(Sphere{0.3f}, {pose.apply(Vec3(0.7f, 0, 0)), kTurn});
  balls.extend(shapeAabb(Sphere{0.3f}, {pose.apply(Vec3(-0.7f, 0, 0)), kTurn}));
  const Aabb box = shapeAabb(Capsule{0.7f, 0.3f}, pose);
  EXPECT_NEAR((box.min - balls.min).norm() + (box.max - balls.max).norm(), 0.0f, 1e-5f);
}

TEST(Collidable, BoundsOfSeveralShapesHoldThemAll) {
  const std::vector<Shape> shapes{{Sphere{0.5f}, {Vec3(2, 0, 0), Quat::Identity()}},
                                  {Box{Vec3(1, 1, 1)}, {}}};
  Collidable c;
  c.external = shapes;
  ASSERT_EQ(c.finish(), Error::Ok);
  EXPECT_NEAR((c.center - Vec3(0.75f, 0, 0)).norm(), 0.0f, 1e-6f);
  EXPECT_NEAR((c.half_extent - Vec3(1.75f, 1, 1)).norm(), 0.0f, 1e-6f);
}

TEST(Collidable, NonsenseIsRefusedWithTheErrorThatNamesIt) {
  Collidable c;
  c.inline_shape.geometry = Sphere{-1.0f};
  EXPECT_EQ(c.finish(), Error::InvalidValue);
  c.inline_shape.geometry = Box{Vec3(1, std::numeric_limits<float>::quiet_NaN(), 1)};
  EXPECT_EQ(c.finish(), Error::InvalidValue);
  c.inline_shape.geometry = static_cast<const ConvexMesh*>(nullptr);
  EXPECT_EQ(c.finish(), Error::NullPointer);
  c.inline_shape = {Sphere{1.0f}, {Vec3::Zero(), Quat(2, 0, 0, 0)}};
  EXPECT_EQ(c.finish(), Error::InvalidValue);
}

TEST(BoxPolytope, EdgesRunCounterClockwiseAroundTheirLeftFace) {
  const BoxPolytope storage(Vec3(1, 2, 3));
  const Polytope p = storage.view();
  for (const PolytopeEdge& e : p.edges) {
    const auto follows = [&](uint32_t f, uint16_t v, uint16_t w) {
      const auto loop = p.face(f);
      for (size_t i = 0; i < loop.size(); ++i) {
        if (loop[i] == v && loop[(i + 1) % loop.size()] == w) return true;
      }
      return false;
    };
    EXPECT_TRUE(follows(e.left, e.v0, e.v1));
    EXPECT_TRUE(follows(e.right, e.v1, e.v0));
  }
  for (uint32_t f = 0; f < 6; ++f) {
    const auto loop = p.face(f);
    const Vec3 n =
        (p.vertices[loop[1]] - p.vertices[loop[0]]).cross(p.vertices[loop[2]] - p.vertices[loop[1]]);
    EXPECT_GT(n.normalized().dot(p.planes[f].normal), 0.999f);
  }
}

}  // namespace
}  // namespace pfx
