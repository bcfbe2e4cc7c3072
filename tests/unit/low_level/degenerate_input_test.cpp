// Input that makes no sense: every public function of collision and rays answers with an error or the
// documented nothing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "pfx/base_level/collision/contact_reduction.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/collision/mesh_seam.h"
#include "pfx/base_level/rigid_body/mass_properties.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/low_level/broadphase/sweep.h"
#include "pfx/low_level/collision/detect.h"
#include "pfx/low_level/continuous/time_of_impact.h"
#include "pfx/low_level/ray/ray_cast.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

ConvexMesh cube() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
  ConvexMesh mesh;
  EXPECT_EQ(buildConvexMesh(corners, mesh), Error::Ok);
  return mesh;
}

LargeMesh ground() {
  const auto soup = pfx_test::flatGrid(4, 1.0f);
  return buildLargeMesh(soup.vertices, soup.indices).mesh;
}

// One of every kind, sizes of zero, and meshes that are not there or empty.
struct Zoo {
  ConvexMesh convex = cube(), no_convex;
  LargeMesh mesh = ground(), no_mesh;
  std::vector<Shape> shapes = {{Sphere{1.0f}, {}},
                               {Box{Vec3::Ones()}, {}},
                               {Capsule{1.0f, 0.5f}, {}},
                               {Cylinder{1.0f, 0.5f}, {}},
                               {&convex, {}},
                               {&mesh, {}},
                               {Sphere{0.0f}, {}},
                               {Box{Vec3::Zero()}, {}},
                               {Capsule{0.0f, 0.0f}, {}},
                               {Cylinder{0.0f, 0.0f}, {}},
                               {static_cast<const ConvexMesh*>(nullptr), {}},
                               {static_cast<const LargeMesh*>(nullptr), {}},
                               {&no_convex, {}},
                               {&no_mesh, {}}};
};

std::vector<Transform> badPoses() {
  std::vector<Transform> poses;
  for (const float bad : {kNan, kInfinite, -kInfinite}) {
    for (int k = 0; k < 3; ++k) {
      Transform t;
      t.position[k] = bad;
      poses.push_back(t);
    }
    for (int k = 0; k < 4; ++k) {
      Transform t;
      t.orientation.coeffs()[k] = bad;
      poses.push_back(t);
    }
  }
  return poses;
}

TEST(DegenerateInput, posesThatAreNotNumbersTouchNothing) {
  const Zoo zoo;
  MeshContactScratch scratch;
  Vector<ContactManifold> found;
  for (const Transform& bad : badPoses())
    for (const Shape& a : zoo.shapes)
      for (const Shape& b : zoo.shapes) {
        ContactManifold m;
        EXPECT_EQ(collideShapes({a, bad, b, {}, 0.1f}, m), 0);
        EXPECT_EQ(collideShapes({a, {}, b, bad, 0.1f}, m), 0);
        EXPECT_EQ(collideMesh({a, bad, b, {}, 0.1f}, scratch, found), 0);
        EXPECT_EQ(collideMesh({a, {}, b, bad, 0.1f}, scratch, found), 0);
      }
  EXPECT_TRUE(found.empty());
}

TEST(DegenerateInput, sizesOfZeroAndMissingMeshesGiveFiniteContactsOrNone) {
  const Zoo zoo;
  MeshContactScratch scratch;
  for (const Shape& a : zoo.shapes)
    for (const Shape& b : zoo.shapes)
      for (const float y : {0.0f, 0.3f, 1e-20f, 1e20f}) {
        Vector<ContactManifold> found(1);
        const Transform pose{.position = Vec3(0.1f, y, 0.0f)};
        collideShapes({a, {}, b, pose, 0.1f}, found[0]);
        collideMesh({a, {}, b, pose, 0.1f}, scratch, found);
        for (const ContactManifold& m : found) {
          EXPECT_TRUE(m.normal.allFinite());
          for (int i = 0; i < m.num_points; ++i)
            EXPECT_TRUE(std::isfinite(m.points[i].distance) && m.points[i].local_a.allFinite());
        }
      }
}

TEST(DegenerateInput, collidablesNameWhatIsWrong) {
  Collidable c;
  for (const Geometry& bad : {Geometry(Sphere{kNan}), Geometry(Box{Vec3(1, -1, 1)}),
                              Geometry(Capsule{kInfinite, 1.0f}), Geometry(Cylinder{1.0f, kNan})}) {
    c.inline_shape = {bad, {}};
    EXPECT_EQ(c.finish(), Error::InvalidValue);
  }
  for (const Transform& pose : badPoses()) {
    c.inline_shape = {Sphere{1.0f}, pose};
    EXPECT_EQ(c.finish(), Error::InvalidValue);
  }
  const Zoo zoo;
  for (const size_t missing : {10u, 11u}) {
    c.inline_shape = zoo.shapes[missing];
    EXPECT_EQ(c.finish(), Error::NullPointer);
  }
}

TEST(DegenerateInput, boundsOfMissingMeshesAreEmptyAndMassOfNothingIsNone) {
  const Zoo zoo;
  for (const size_t missing : {10u, 11u, 12u}) {
    const Aabb box = shapeAabb(zoo.shapes[missing].geometry, {});
    EXPECT_FALSE((box.min.array() <= box.max.array()).all());
  }
  for (size_t i = 6; i < zoo.shapes.size(); ++i) {
    const auto mass = massProperties(std::span(&zoo.shapes[i], 1), 1000.0f);
    EXPECT_FALSE(scaledToMass(mass, 1.0f)) << i;
  }
}

TEST(DegenerateInput, hullsAndMeshesOfNothingAreRefused) {
  ConvexMesh convex;
  EXPECT_EQ(buildConvexMesh({}, convex), Error::Degenerate);
  const std::vector<Vec3> same(10, Vec3::Ones()),
      nan = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, kNan, 1)};
  EXPECT_EQ(buildConvexMesh(same, convex), Error::Degenerate);
  EXPECT_EQ(buildConvexMesh(nan, convex), Error::InvalidValue);
  EXPECT_EQ(checkConvexMesh(same, std::vector<uint32_t>{0, 1}, convex), Error::OutOfRange);
  EXPECT_EQ(checkConvexMesh(same, std::vector<uint32_t>{0, 1, 10}, convex), Error::OutOfRange);

  const std::vector<Vec3> corner = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
  const std::vector<uint32_t> one = {0, 1, 2}, beyond = {0, 1, 3}, two = {0, 1}, twice = {0, 1, 2, 1, 2, 0},
                              flat = {0, 1, 1};
  EXPECT_EQ(buildLargeMesh({}, one).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(corner, {}).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(corner, flat).error, Error::Degenerate);
  EXPECT_EQ(buildLargeMesh(nan, std::vector<uint32_t>{0, 1, 3}).error, Error::InvalidValue);
  EXPECT_EQ(buildLargeMesh(corner, beyond).error, Error::OutOfRange);
  EXPECT_EQ(buildLargeMesh(corner, two).error, Error::OutOfRange);
  EXPECT_EQ(buildLargeMesh(corner, one, {.thickness = kNan}).error, Error::InvalidValue);
  const auto duplicate = buildLargeMesh(corner, twice);
  EXPECT_EQ(duplicate.error, Error::Ok);
  EXPECT_EQ(duplicate.dropped_duplicate, 1u);
  LargeMesh mesh = ground();
  EXPECT_EQ(replaceVertices(mesh, corner), Error::OutOfRange);
}

TEST(DegenerateInput, raysAndCastsAtNonsenseHitNothing) {
  const Zoo zoo;
  std::vector<RigidState> states;
  std::vector<Collidable> collidables;
  for (const Transform& bad : badPoses()) {
    RigidState s;
    s.position = bad.position;
    s.orientation = bad.orientation;
    for (const Shape& shape : zoo.shapes) {
      states.push_back(s);
      collidables.emplace_back().inline_shape = shape;
    }
  }
  const QueryScene scene{states, collidables};
  const RayInput ray{.start = Vec3(0, 5, 0), .direction = Vec3(0, -10, 0)};
  EXPECT_FALSE(castRay(ray, scene).hit);
  const Geometry ball = Sphere{0.5f};
  EXPECT_FALSE(
      castShape({.geometry = ball, .start = {.position = ray.start}, .motion = ray.direction}, scene).hit);
  std::vector<uint32_t> bodies;
  findOverlaps({.geometry = ball, .pose = {}}, scene, bodies);
  EXPECT_TRUE(bodies.empty());

  // The same probes, missing and at places that are not numbers, at a body that is there.
  const RigidState there;
  Collidable box;
  box.inline_shape = {Box{Vec3::Ones()}, {}};
  EXPECT_EQ(box.finish(), Error::Ok);
  const QueryScene sound{{&there, 1}, {&box, 1}};
  for (size_t i = 10; i < zoo.shapes.size(); ++i) {
    const Geometry& probe = zoo.shapes[i].geometry;
    EXPECT_FALSE(
        castShape({.geometry = probe, .start = {.position = ray.start}, .motion = ray.direction}, sound).hit);
    findOverlaps({.geometry = probe, .pose = {}}, sound, bodies);
  }
  for (const Transform& bad : badPoses()) {
    EXPECT_FALSE(castShape({.geometry = ball, .start = bad, .motion = ray.direction}, sound).hit);
    EXPECT_FALSE(
        castShape({.geometry = ball, .start = {}, .motion = bad.position + Vec3::Constant(kNan)}, sound).hit);
    findOverlaps({.geometry = ball, .pose = bad}, sound, bodies);
  }
  EXPECT_TRUE(bodies.empty());
  // More states than collidables: those without one are not there.
  EXPECT_FALSE(castRay(ray, {states, {}}).hit);
}

TEST(DegenerateInput, timesOfImpactOfNonsenseAreNone) {
  const Zoo zoo;
  const Shape ball{Sphere{0.5f}, {}};
  const Sweep down{.start = {.position = Vec3(0, 5, 0)}, .motion = Vec3(0, -10, 0)};
  for (const Transform& bad : badPoses())
    for (const Shape& shape : zoo.shapes) {
      EXPECT_FALSE(timeOfImpact({shape, {.start = bad}, ball, down}).touches());
      EXPECT_FALSE(timeOfImpact({shape, {}, ball, {.start = bad, .motion = down.motion}}).touches());
      EXPECT_FALSE(
          timeOfImpact({shape, {}, ball, {.start = down.start, .motion = Vec3::Constant(kNan)}}).touches());
      EXPECT_FALSE(
          timeOfImpact({shape, {}, ball, {.start = down.start, .rotation = Vec3::Constant(kInfinite)}})
              .touches());
    }
  for (size_t i = 10; i < zoo.shapes.size(); ++i)
    EXPECT_FALSE(timeOfImpact({zoo.shapes[i], {}, ball, down}).touches());
}

TEST(DegenerateInput, detectionRefusesIdsOutOfRange) {
  std::vector<RigidState> states(2);
  std::vector<Collidable> collidables(2);
  std::vector<ContactReach> reach(2);
  ContactStore contacts;
  const uint32_t id = contacts.add();
  TaskManager tasks;
  CollisionDetector detector;
  const auto detect = [&](const Pair& pair, size_t num_collidables) {
    return detector.detect({states, std::span(collidables).first(num_collidables), reach, {&pair, 1}},
                           contacts, tasks);
  };
  EXPECT_EQ(detect({0, 1, id, 0}, 2), Error::Ok);
  EXPECT_EQ(detect({0, 2, id, 0}, 2), Error::OutOfRange);
  EXPECT_EQ(detect({7, 1, id, 0}, 2), Error::OutOfRange);
  EXPECT_EQ(detect({0, 1, id + 1, 0}, 2), Error::OutOfRange);
  EXPECT_EQ(detect({0, 1, kNoContact, 0}, 2), Error::OutOfRange);
  EXPECT_EQ(detect({0, 1, id, 0}, 1), Error::OutOfRange);
}

TEST(DegenerateInput, candidatesThatAreNotNumbersDoNotBreakTheFourPointRule) {
  LocalManifold m;
  reduceContacts({}, m);
  EXPECT_EQ(m.num_points, 0);
  std::vector<LocalContact> candidates(9, LocalContact{Vec3::Constant(kNan), Vec3::Constant(kNan), kNan, 0});
  reduceContacts(candidates, m);
  EXPECT_LE(m.num_points, kMaxContactPoints);
  std::fill(candidates.begin(), candidates.end(), LocalContact{Vec3::Zero(), Vec3::Zero(), 0.0f, 0});
  reduceContacts(candidates, m);
  EXPECT_LE(m.num_points, kMaxContactPoints);
}

TEST(DegenerateInput, anAxisThatIsNotOneOfThreeIsRefused) {
  SweepBroadphase sweep;
  std::array<Pair, 4> pairs;
  const std::array<BroadphaseProxy, 2> proxies;
  for (const int axis : {-1, 3, 1 << 20})
    EXPECT_EQ(findPairs(sweep, proxies, axis, pairs).error, Error::OutOfRange);
}

}  // namespace
}  // namespace pfx
