// Proxies, pairs, contacts and rays of a crowd: the same bits for any number of workers, step after step.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <memory>

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/high_level/world/world.h"
#include "pfx/low_level/broadphase/shape_tree.h"
#include "pfx/low_level/broadphase/sweep.h"
#include "pfx/low_level/broadphase/tree_broadphase.h"
#include "pfx/low_level/collision/detect.h"
#include "pfx/low_level/ray/ray_cast.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

constexpr uint32_t kBodies = 700;

struct Random {
  uint64_t state = 21;
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

// Two meshes that meet, and on them all kinds of shapes, with compounds of three and of twenty.
struct Crowd {
  LargeMesh left, right;
  ConvexMesh hull;
  std::vector<std::vector<Shape>> compounds;
  std::vector<DynamicTree> trees;
  std::vector<RigidState> states;
  std::vector<Collidable> collidables;

  Crowd() {
    auto soup = pfx_test::bumpyGrid(20, 0.5f);
    left = buildLargeMesh(soup.vertices, soup.indices).mesh;
    for (Vec3& v : soup.vertices) v.x() += 10.0f;
    right = buildLargeMesh(soup.vertices, soup.indices, {.type = LargeMeshType::QuantizedBvh}).mesh;
    Random random;
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i) points.push_back(0.3f * random.vector(1.0f).normalized());
    EXPECT_EQ(buildConvexMesh(points, hull), Error::Ok);
    compounds.reserve(kBodies);
    trees.reserve(kBodies);
    for (uint32_t i = 0; i < kBodies; ++i) add(i, random);
  }

  void add(uint32_t i, Random& random) {
    RigidState s;
    Collidable c;
    s.body_id = i;
    if (i < 2) {
      s.motion_type = MotionType::Fixed;
      c.inline_shape = {i == 0 ? &left : &right, {}};
    } else {
      s.position = random.vector(5.0f) + Vec3(5, 1, 0);
      s.orientation = random.turn();
      s.linear_velocity = random.vector(3.0f);
      const Geometry kinds[] = {Sphere{0.3f}, Box{Vec3(0.2f, 0.3f, 0.2f)}, Capsule{0.2f, 0.2f},
                                Cylinder{0.2f, 0.3f}, &hull};
      c.inline_shape = {kinds[i % 5], {}};
      if (const int parts = i % 11 == 0 ? 20 : i % 7 == 0 ? 3 : 0; parts > 0) {
        auto& shapes = compounds.emplace_back();
        for (int k = 0; k < parts; ++k) {
          const Vec3 at = random.vector(0.3f);
          shapes.push_back({Sphere{0.1f}, {at, random.turn()}});
        }
        c.external = shapes;
        if (parts > static_cast<int>(kShapesWithoutTree))
          c.shape_tree = &trees.emplace_back(makeShapeTree(shapes));
      }
    }
    EXPECT_EQ(c.finish(), Error::Ok);
    states.push_back(s);
    collidables.push_back(c);
  }

  void move(float dt) {
    for (RigidState& s : states) s.position += dt * s.linear_velocity;
  }
};

// Mixes the bits of numbers.
struct Hash {
  uint64_t value = 0xcbf29ce484222325ull;
  void add(uint32_t x) { value = (value ^ x) * 0x100000001b3ull; }
  void add(float x) { add(std::bit_cast<uint32_t>(x)); }
  void add(const Vec3& v) { add(v.x()), add(v.y()), add(v.z()); }
};

void addContacts(const ContactStore& contacts, std::span<const Pair> pairs, Hash& hash) {
  for (const Pair& p : pairs)
    for (const ContactManifold& m : contacts.manifolds(p.contact_id)) {
      hash.add(m.normal);
      for (int i = 0; i < m.num_points; ++i)
        hash.add(m.points[i].local_a), hash.add(m.points[i].distance), hash.add(m.points[i].feature);
    }
}

struct Outcome {
  std::vector<uint64_t> hashes;  // of pairs, contacts and rays of each step
  size_t points = 0;
};

Outcome run(int workers) {
  Crowd crowd;
  TaskManager tasks(workers, Sharing::Always);
  SweepBroadphase sweep;
  TreeBroadphase tree;
  CollisionDetector detector;
  ContactStore contacts;
  std::vector<BroadphaseProxy> proxies(kBodies);
  std::vector<ContactReach> reach(kBodies, {.resting = 0.005f, .travel = 0.02f});
  Outcome outcome;
  for (int step = 0; step < 8; ++step) {
    Hash hash;
    updateProxies(crowd.states, crowd.collidables, {.margin = 0.025f}, proxies, &tasks);
    tree.update(proxies, &tasks);
    const auto found = sweep.findPairs(proxies, axisOfLargestVariance(proxies), &tasks);
    const auto same = tree.activePairs();
    EXPECT_TRUE(std::ranges::equal(found, same, {}, &Pair::key, &Pair::key));
    std::vector<Pair> pairs(found.begin(), found.end());
    contacts.clear();
    for (Pair& p : pairs) p.contact_id = contacts.add(), hash.add(p.body_a), hash.add(p.body_b);
    // Twice: the second time contacts have their blocks, and those that keep their manifolds are measured
    // again.
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(detector.detect({crowd.states, crowd.collidables, reach, pairs}, contacts, tasks), Error::Ok);
      addContacts(contacts, pairs, hash);
    }
    std::vector<RayInput> rays(500);
    std::vector<RayOutput> hits(rays.size());
    Random random{99};
    for (RayInput& r : rays)
      r = {.start = random.vector(6.0f) + Vec3(5, 6, 0), .direction = random.vector(3.0f) - Vec3(0, 10, 0)};
    EXPECT_EQ(castRays(rays, {crowd.states, crowd.collidables, &tree}, hits, &tasks), Error::Ok);
    for (const RayOutput& h : hits) hash.add(h.body), hash.add(h.fraction), hash.add(h.normal);
    for (const Pair& p : pairs)
      for (const ContactManifold& m : contacts.manifolds(p.contact_id))
        outcome.points += static_cast<size_t>(m.num_points);
    outcome.hashes.push_back(hash.value);
    crowd.move(0.02f);
  }
  return outcome;
}

TEST(CollisionWorkers, stagesGiveTheSameBitsForAnyNumberOfThem) {
  const Outcome one = run(1);
  EXPECT_GT(one.points, 3000u);
  for (const int workers : {2, 3, 4}) EXPECT_EQ(run(workers).hashes, one.hashes) << workers;
}

TEST(CollisionWorkers, aStormOfFastBodiesIsTheSameForAnyNumberOfThem) {
  const auto storm = [](int workers) {
    World world({.workers = workers});
    auto soup = pfx_test::bumpyGrid(20, 0.5f);
    world.addBody({.motion_type = MotionType::Fixed,
                   .shapes = {{world.keep(buildLargeMesh(soup.vertices, soup.indices).mesh), {}}}});
    for (Vec3& v : soup.vertices) v.x() += 10.0f;
    world.addBody({.motion_type = MotionType::Fixed,
                   .shapes = {{world.keep(buildLargeMesh(soup.vertices, soup.indices).mesh), {}}}});
    Random random{7};
    for (int i = 0; i < 600; ++i) {
      const Geometry kinds[] = {Sphere{0.1f}, Box{Vec3(0.1f, 0.05f, 0.1f)}, Capsule{0.1f, 0.05f}};
      const Vec3 at = random.vector(4.0f) + Vec3(5, 6, 0);
      world.addBody({.pose = {at, random.turn()},
                     .linear_velocity = Vec3(0, -60, 0) + random.vector(40.0f),
                     .shapes = {{kinds[i % 3], {}}}});
    }
    for (int i = 0; i < 20; ++i) world.step(1.0f / 60.0f);
    return world.stateHash();
  };
  const uint64_t one = storm(1);
  for (const int workers : {2, 3, 4}) EXPECT_EQ(storm(workers), one) << workers;
}

}  // namespace
}  // namespace pfx
