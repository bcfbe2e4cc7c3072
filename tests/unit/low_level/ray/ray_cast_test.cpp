// Queries over many bodies against brute force, with and without the tree, on one thread and on several.
#include "pfx/low_level/ray/ray_cast.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

struct Random {
  uint64_t state = 11;
  float next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<float>(state >> 40) / 16777216.0f;
  }
  Vec3 vector(float size) {
    const float x = next(), y = next(), z = next();
    return size * Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  }
};

// A bumpy ground, 300 primitives of all kinds, compounds among them.
struct Bodies {
  LargeMesh ground;
  std::vector<RigidState> states;
  std::vector<Collidable> collidables;
  std::vector<std::array<Shape, 2>> compounds;
  TreeBroadphase tree;

  QueryScene scene(bool with_tree = true) const { return {states, collidables, with_tree ? &tree : nullptr}; }
};

std::unique_ptr<Bodies> makeBodies() {
  auto b = std::make_unique<Bodies>();
  const auto soup = pfx_test::bumpyGrid(40, 0.5f);
  std::vector<uint32_t> data(soup.numTriangles());
  for (uint32_t i = 0; i < data.size(); ++i) data[i] = 7 * i;
  b->ground = buildLargeMesh(soup.vertices, soup.indices, {.user_data = data}).mesh;
  Random random;
  b->compounds.reserve(100);
  for (int i = 0; i < 301; ++i) {
    RigidState s;
    Collidable c;
    s.body_id = static_cast<uint32_t>(i);
    if (i == 0) {
      s.motion_type = MotionType::Fixed;
      c.inline_shape = {&b->ground, {}};
    } else {
      s.position = random.vector(9.0f) + Vec3(0, 6, 0);
      s.orientation = Quat(Eigen::AngleAxisf(3.0f * random.next(), random.vector(1.0f).normalized()));
      const Geometry kinds[] = {Sphere{0.4f}, Box{Vec3(0.3f, 0.5f, 0.2f)}, Capsule{0.4f, 0.2f}, Cylinder{0.3f, 0.3f}};
      c.inline_shape = {kinds[i % 4], {}};
      if (i % 5 == 0) {
        b->compounds.push_back({Shape{kinds[i % 4], {Vec3(0.5f, 0, 0), Quat::Identity()}},
                                Shape{kinds[(i + 1) % 4], {Vec3(-0.5f, 0, 0), Quat::Identity()}}});
        c.external = b->compounds.back();
      }
    }
    EXPECT_EQ(c.finish(), Error::Ok);
    b->states.push_back(s);
    b->collidables.push_back(c);
  }
  std::vector<BroadphaseProxy> proxies(b->states.size());
  updateProxies(b->states, b->collidables, {}, proxies);
  b->tree.update(proxies);
  return b;
}

std::vector<RayInput> makeRays(int n) {
  Random random;
  std::vector<RayInput> rays(static_cast<size_t>(n));
  for (RayInput& r : rays) {
    r.start = random.vector(12.0f) + Vec3(0, 6, 0);
    r.direction = random.vector(10.0f) - r.start;
    r.facet_mode = static_cast<FacetMode>(static_cast<int>(3.0f * random.next()));
  }
  return rays;
}

bool same(const RayOutput& a, const RayOutput& b) {
  return a.hit == b.hit && a.fraction == b.fraction && a.body == b.body && a.shape == b.shape && a.point == b.point &&
         a.normal == b.normal && a.triangle == b.triangle && a.island == b.island && a.barycentric == b.barycentric;
}

TEST(RayCast, treeAndEveryBodyGiveTheSameHits) {
  const auto bodies = makeBodies();
  int hits = 0, mesh_hits = 0;
  for (const RayInput& ray : makeRays(5000)) {
    const RayOutput a = castRay(ray, bodies->scene(true)), b = castRay(ray, bodies->scene(false));
    ASSERT_TRUE(same(a, b));
    hits += a.hit;
    mesh_hits += a.hit && a.body == 0;
    if (!a.hit) continue;
    EXPECT_LT((a.point - (ray.start + a.fraction * ray.direction)).norm(), 1e-5f);
    EXPECT_LE(a.normal.dot(ray.direction), 1e-5f);
    if (a.body == 0) {
      EXPECT_EQ(a.user_data, 7 * bodies->ground.source[a.triangle]);
      EXPECT_EQ(a.island, islandOf(bodies->ground, a.triangle));
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(mesh_hits, 200);
}

TEST(RayCast, batchesGiveTheSameAsSinglesForAnyNumberOfWorkers) {
  const auto bodies = makeBodies();
  const auto rays = makeRays(2000);
  std::vector<RayOutput> outputs(rays.size());
  for (const int workers : {0, 1, 2, 4}) {
    std::unique_ptr<TaskManager> tasks;
    if (workers > 0) tasks = std::make_unique<TaskManager>(workers);
    ASSERT_EQ(castRays(rays, bodies->scene(), outputs, tasks.get()), Error::Ok);
    for (size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(same(outputs[i], castRay(rays[i], bodies->scene())));
  }
  EXPECT_EQ(castRays(rays, bodies->scene(), std::span(outputs).first(3)), Error::OutOfRange);
}

TEST(RayCast, filtersWorkBothWays) {
  auto bodies = makeBodies();
  RayInput ray{.start = Vec3(0, 20, 0), .direction = Vec3(0, -40, 0)};
  ray.filter_target = 0;
  EXPECT_FALSE(castRay(ray, bodies->scene()).hit);
  ray.filter_target = 0xffffffffu;
  ASSERT_TRUE(castRay(ray, bodies->scene()).hit);
  for (RigidState& s : bodies->states) s.filter_target = 2;
  ray.filter_self = 1;
  EXPECT_FALSE(castRay(ray, bodies->scene()).hit);
}

TEST(RayCast, raysThatAreNotNumbersOrHaveNoLengthHitNothing) {
  const auto bodies = makeBodies();
  RayInput ray{.start = Vec3(0, 20, 0), .direction = Vec3(0, -40, 0)};
  ray.start.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(castRay(ray, bodies->scene()).hit);
  EXPECT_FALSE(castRay({.start = Vec3(0, 20, 0)}, bodies->scene()).hit);
  EXPECT_FALSE(castRay({.start = Vec3(0, 20, 0), .direction = Vec3(0, -40, 0)}, QueryScene{}).hit);
}

TEST(ShapeCast, aSmallSphereHitsWhereARayHits) {
  const auto bodies = makeBodies();
  const Geometry tiny = Sphere{1e-3f};
  int hits = 0;
  for (RayInput ray : makeRays(300)) {
    ray.facet_mode = FacetMode::FrontOnly;
    const RayOutput r = castRay(ray, bodies->scene());
    const ShapeCastOutput s = castShape({tiny, {ray.start, Quat::Identity()}, ray.direction}, bodies->scene());
    if (s.overlaps || !r.hit || -r.normal.dot(ray.direction.normalized()) < 0.2f) continue;
    ++hits;
    ASSERT_TRUE(s.hit);
    // Its radius and the tolerance earlier, at the angle of incidence.
    EXPECT_LT(std::abs(s.fraction - r.fraction) * ray.direction.norm(), 1.2e-3f / 0.2f);
  }
  EXPECT_GT(hits, 50);
}

TEST(ShapeCast, treeAndEveryBodyGiveTheSameFirstTouch) {
  const auto bodies = makeBodies();
  const Geometry box = Box{Vec3(0.3f, 0.1f, 0.2f)};
  int hits = 0;
  for (const RayInput& ray : makeRays(200)) {
    const ShapeCastInput input{box, {ray.start, Quat(Eigen::AngleAxisf(1.0f, Vec3::UnitX()))}, ray.direction};
    const ShapeCastOutput a = castShape(input, bodies->scene(true)), b = castShape(input, bodies->scene(false));
    ASSERT_EQ(a.hit, b.hit);
    ASSERT_EQ(a.fraction, b.fraction);
    ASSERT_EQ(a.body, b.body);
    ASSERT_EQ(a.triangle, b.triangle);
    hits += a.hit;
  }
  EXPECT_GT(hits, 50);
}

TEST(Overlaps, treeAndEveryBodyGiveTheSameBodies) {
  const auto bodies = makeBodies();
  const Geometry ball = Sphere{2.0f};
  Random random;
  size_t found = 0;
  for (int i = 0; i < 50; ++i) {
    const OverlapInput input{ball, {random.vector(8.0f) + Vec3(0, 5, 0), Quat::Identity()}};
    std::vector<uint32_t> a, b;
    findOverlaps(input, bodies->scene(true), a);
    findOverlaps(input, bodies->scene(false), b);
    ASSERT_EQ(a, b);
    found += a.size();
  }
  EXPECT_GT(found, 50u);
}

}  // namespace
}  // namespace pfx
