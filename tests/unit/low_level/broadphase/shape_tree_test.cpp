// Compounds of many shapes: the tree of their bounds changes nothing but the time that it takes.
#include "pfx/low_level/broadphase/shape_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pfx/high_level/world/world.h"
#include "pfx/low_level/collision/body_pair.h"
#include "pfx/low_level/ray/ray_cast.h"

namespace pfx {
namespace {

struct Random {
  uint64_t state = 5;
  float next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<float>(state >> 40) / 16777216.0f;
  }
  Vec3 vector(float size) {
    const float x = next(), y = next(), z = next();
    return size * Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  }
  Quat turn() { return Quat(Eigen::AngleAxisf(3.0f * next(), vector(1.0f).normalized())); }
};

// A cloud of 300 spheres, boxes and capsules.
struct Compound {
  std::vector<Shape> shapes;
  DynamicTree tree;
  Collidable with, without;

  explicit Compound(uint64_t seed) {
    Random random{seed};
    for (int i = 0; i < 300; ++i) {
      const Geometry kinds[] = {Sphere{0.1f}, Box{Vec3(0.1f, 0.2f, 0.05f)}, Capsule{0.1f, 0.05f}};
      const Vec3 at = random.vector(2.0f);
      shapes.push_back({kinds[i % 3], {at, random.turn()}});
    }
    tree = makeShapeTree(shapes);
    without.external = shapes;
    EXPECT_EQ(without.finish(), Error::Ok);
    with = without;
    with.shape_tree = &tree;
  }
};

TEST(ShapeTree, twoCompoundsTouchInTheSamePoints) {
  const Compound a(1), b(2);
  Random random{3};
  size_t points = 0;
  for (int i = 0; i < 20; ++i) {
    const Transform pose_a{random.vector(2.0f), random.turn()}, pose_b{random.vector(2.0f), random.turn()};
    const auto collide = [&](const Collidable& x, const Collidable& y) {
      Vector<ContactManifold> found;
      FoundManifolds out{found};
      MeshContactScratch scratch;
      PairCache cache;
      collideBodies({x, y, pose_a, pose_b, 0.02f}, cache, scratch, out);
      std::vector<std::pair<uint32_t, float>> all;
      for (const ContactManifold& m : found)
        for (int k = 0; k < m.num_points; ++k) all.push_back({m.points[k].feature, m.points[k].distance});
      std::sort(all.begin(), all.end());
      return all;
    };
    const auto expected = collide(a.without, b.without);
    EXPECT_EQ(collide(a.with, b.with), expected);
    EXPECT_EQ(collide(a.with, b.without), expected);
    EXPECT_EQ(collide(a.without, b.with), expected);
    points += expected.size();
  }
  EXPECT_GT(points, 500u);
}

TEST(ShapeTree, raysCastsAndOverlapsAreTheSame) {
  const Compound compound(4);
  Random random{6};
  RigidState state;
  state.position = Vec3(100.0f, -50.0f, 30.0f);
  state.orientation = random.turn();
  const QueryScene with{{&state, 1}, {&compound.with, 1}}, without{{&state, 1}, {&compound.without, 1}};
  const Geometry probe = Sphere{0.05f};
  int hits = 0, overlaps = 0;
  for (int i = 0; i < 2000; ++i) {
    RayInput ray{.start = state.position + random.vector(3.0f)};
    ray.direction = state.position + random.vector(2.0f) - ray.start;
    const RayOutput a = castRay(ray, with), b = castRay(ray, without);
    ASSERT_EQ(a.hit, b.hit);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.fraction, b.fraction);
    hits += a.hit;
    const Transform start{.position = ray.start};
    const auto cast_a = castShape({.geometry = probe, .start = start, .motion = ray.direction}, with);
    const auto cast_b = castShape({.geometry = probe, .start = start, .motion = ray.direction}, without);
    EXPECT_EQ(cast_a.hit, cast_b.hit);
    EXPECT_EQ(cast_a.shape, cast_b.shape);
    EXPECT_EQ(cast_a.fraction, cast_b.fraction);
    std::vector<uint32_t> over_a, over_b;
    findOverlaps({.geometry = probe, .pose = start}, with, over_a);
    findOverlaps({.geometry = probe, .pose = start}, without, over_b);
    EXPECT_EQ(over_a, over_b);
    overlaps += !over_a.empty();
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(overlaps, 5);
}

TEST(ShapeTree, aCubeOf512BoxesLandsFlatAndTheSameForAnyNumberOfWorkers) {
  std::vector<Shape> parts;
  for (int i = 0; i < 512; ++i) {
    const Vec3 cell(static_cast<float>(i % 8), static_cast<float>(i / 8 % 8), static_cast<float>(i / 64));
    parts.push_back({Box{Vec3::Constant(0.0625f)}, {(cell - Vec3::Constant(3.5f)) * 0.125f, Quat::Identity()}});
  }
  const auto drop = [&](int workers) {
    World world({.workers = workers});
    world.addBody(
        {.pose = {.position = Vec3(0, -1, 0)}, .motion_type = MotionType::Fixed, .shapes = {{Box{Vec3(5, 1, 5)}, {}}}});
    const BodyId id = world.addBody({.pose = {.position = Vec3(0, 1.2f, 0)}, .shapes = parts, .restitution = 0.0f});
    for (int i = 0; i < 90; ++i) world.step(1.0f / 60.0f);
    EXPECT_NEAR(world.states()[id.index].position.y(), 0.5f, 1e-3f);
    EXPECT_NEAR((world.states()[id.index].orientation * Vec3::UnitY()).y(), 1.0f, 1e-5f);
    EXPECT_LT(world.states()[id.index].linear_velocity.norm(), 1e-3f);
    return world.stateHash();
  };
  EXPECT_EQ(drop(3), drop(1));
}

}  // namespace
}  // namespace pfx
