// ACC-28: bodies that slide over a plane made of triangles move as they would on a plane.
#include <gtest/gtest.h>

#include <cmath>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

struct Slide {
  Geometry shape;
  float height;    // m, of the centre above the ground at rest
  float speed;     // m/s
  float friction;
};

struct Outcome {
  float vertical = 0.0f;  // m/s, largest after the first quarter second
  float lateral = 0.0f;   // m
  float speed = 0.0f;     // m/s, at the end
  float travelled = 0.0f; // m
  float lowest = 1.0f;    // m, of the centre above its height at rest
};

Outcome slide(const Slide& s, const Geometry& ground, const Transform& ground_offset) {
  World world;
  BodyDef floor;
  floor.motion_type = MotionType::Fixed;
  floor.shapes = {{ground, ground_offset}};
  floor.friction = s.friction;
  world.addBody(floor);
  BodyDef body;
  body.pose.position = Vec3(-4.71f, s.height, 0.013f);
  body.linear_velocity = Vec3(s.speed, 0, 0);
  body.shapes = {{s.shape, {}}};
  body.friction = s.friction;
  body.restitution = 0.0f;
  const BodyId id = world.addBody(body);

  Outcome o;
  const float dt = 1.0f / 60.0f;
  for (int i = 0; i < 600 && world.states()[id.index].position.x() < 4.3f; ++i) {
    world.step(dt);
    const RigidState& state = world.states()[id.index];
    if (i >= 15) o.vertical = std::max(o.vertical, std::abs(state.linear_velocity.y()));
    o.lateral = std::max(o.lateral, std::abs(state.position.z() - 0.013f));
    o.lowest = std::min(o.lowest, state.position.y() - s.height);
    o.speed = state.linear_velocity.norm();
    o.travelled = state.position.x() + 4.71f;
  }
  return o;
}

const Geometry kBox = Box{Vec3(0.1f, 0.1f, 0.1f)};
const Geometry kSphere = Sphere{0.1f};
const Geometry kCapsule = Capsule{0.2f, 0.1f};

TEST(MeshSlide, boxesSpheresAndCapsulesSlideOverATriangulatedPlaneAsOverAPlane) {
  const auto soup = pfx_test::flatGrid(100, 0.1f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  for (const Geometry& shape : {kBox, kSphere, kCapsule}) {
    for (const float speed : {1.0f, 5.0f, 20.0f}) {
      for (const float friction : {0.0f, 0.5f}) {
        const Slide s{shape, 0.1f, speed, friction};
        const Outcome m = slide(s, &mesh, {});
        const Outcome p = slide(s, Box{Vec3(50, 1, 50)}, {Vec3(0, -1, 0), Quat::Identity()});
        SCOPED_TRACE(testing::Message() << "shape " << shape.index() << " speed " << speed << " friction " << friction);
        EXPECT_LT(m.vertical, std::max(1e-4f, 1.2f * p.vertical));
        // A body that comes to rest does so somewhere within a step: half mu g dt^2 of distance.
        EXPECT_NEAR(m.travelled, p.travelled, 1e-3f * p.travelled + 0.5f * friction * 9.8f / 3600.0f);
        EXPECT_NEAR(m.lowest, p.lowest, 1e-4f) << "no deeper than on the plane";
        if (friction == 0.0f) {
          EXPECT_NEAR(m.speed, speed, 1e-4f * speed);
          EXPECT_LT(m.lateral, 1e-5f);
        }
      }
    }
  }
}

TEST(MeshSlide, aSlabOver50000TrianglesRestsLevel) {
  const auto soup = pfx_test::flatGrid(180, 0.1f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  World world;
  BodyDef floor;
  floor.motion_type = MotionType::Fixed;
  floor.shapes = {{&mesh, {}}};
  world.addBody(floor);
  BodyDef slab;
  slab.pose.position = Vec3(0.02f, 0.52f, -0.01f);
  slab.shapes = {{Box{Vec3(8.03f, 0.5f, 8.01f)}, {}}};
  slab.mass = 1000.0f;
  const BodyId id = world.addBody(slab);
  for (int i = 0; i < 90; ++i) world.step(1.0f / 60.0f);
  const RigidState& state = world.states()[id.index];
  EXPECT_NEAR(state.position.y(), 0.5f, 1e-3f);
  // One millimetre over its width of 16 m, as half an angle.
  EXPECT_LT(state.orientation.vec().norm(), 3e-5f);
  EXPECT_LT(state.linear_velocity.norm(), 1e-3f);
}

}  // namespace
}  // namespace pfx
