// Times of impact: closed forms, and that nothing is ever missed.
#include "pfx/low_level/continuous/time_of_impact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/support/meshes.h"

namespace pfx {
namespace {

struct Random {
  uint64_t state = 3;
  float next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<float>(state >> 40) / 16777216.0f;
  }
  Vec3 vector() {
    const float x = next(), y = next(), z = next();
    return {2 * x - 1, 2 * y - 1, 2 * z - 1};
  }
};

Quat turn(float angle, const Vec3& axis) { return Quat(Eigen::AngleAxisf(angle, axis.normalized())); }

TEST(TimeOfImpact, headOnShapesMeetWhenTheGapIsUsedUp) {
  const Shape a{Sphere{0.5f}, {}}, b{Box{Vec3(0.5f, 1, 1)}, {}};
  const Sweep still{{Vec3(0, 0, 0), Quat::Identity()}};
  const Sweep fast{{Vec3(11, 0, 0), Quat::Identity()}, Vec3(-40, 0, 0)};
  const Impact hit = timeOfImpact({a, still, b, fast});
  ASSERT_EQ(hit.state, Impact::State::Hit);
  EXPECT_NEAR(hit.fraction, 0.25f, 1e-4f / 40.0f);
  EXPECT_LT((hit.normal - Vec3::UnitX()).norm(), 1e-5f);
  EXPECT_LT((hit.point - Vec3(0.5f, 0, 0)).norm(), 2e-4f);
  EXPECT_FALSE(timeOfImpact({a, still, b, fast, 1e-4f, 0.24f}).touches()) << "looks no further than asked";
  const Sweep beside{{Vec3(11, 0, 1.51f), Quat::Identity()}, Vec3(-40, 0, 0)};
  EXPECT_FALSE(timeOfImpact({a, still, b, beside}).touches());
}

TEST(TimeOfImpact, whatTouchesAndPartsIsNoImpactAndWhatOverlapsSaysSo) {
  const Shape a{Sphere{0.5f}, {}};
  const Sweep still{};
  const Sweep away{{Vec3(1.00005f, 0, 0), Quat::Identity()}, Vec3(3, 0, 0)};
  EXPECT_FALSE(timeOfImpact({a, still, a, away}).touches());
  const Sweep inside{{Vec3(0.0f, 0, 0), Quat::Identity()}, Vec3(3, 0, 0)};
  EXPECT_EQ(timeOfImpact({a, still, a, inside}).state, Impact::State::Overlaps);
}

TEST(TimeOfImpact, aTurningRodIsCaughtAtItsTip) {
  // A rod along x turns about y by 180 degrees in the interval; a small ball waits beside it at angle phi.
  const Shape rod{Box{Vec3(1, 0.01f, 0.01f)}, {}}, ball{Sphere{0.02f}, {}};
  const Sweep turning{{Vec3::Zero(), Quat::Identity()}, Vec3::Zero(), Vec3(0, 3.14159265f, 0)};
  for (const float phi : {0.3f, 1.0f, 2.0f, 2.8f}) {
    const Vec3 at = 0.95f * Vec3(cos(phi), 0, -sin(phi));
    const Sweep still{{at, Quat::Identity()}};
    const Impact hit = timeOfImpact({rod, turning, ball, still});
    ASSERT_TRUE(hit.touches()) << phi;
    // Side of the rod meets the ball when its axis is asin((0.01 + 0.02) / 0.95) before it. The far half of the rod
    // comes first for balls it reaches sooner.
    const float before = std::asin(0.03f / 0.95f);
    EXPECT_NEAR(hit.fraction, (phi - before) / 3.14159265f, 2e-4f) << phi;
  }
}

TEST(TimeOfImpact, everySphereMeetsAThinQuadAtTheAnalyticTime) {
  // ACC-29: faces, edges and vertices of two triangles without thickness, 10 to 1000 m/s, grazing from 1 degree.
  const std::vector<Vec3> v = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
  LargeMeshResult built = buildLargeMesh(v, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}, {.thickness = 0.0f});
  ASSERT_EQ(built.error, Error::Ok);
  const Shape quad{&built.mesh, {}}, ball{Sphere{0.05f}, {}};
  const Sweep still{};
  Random random;
  int missed = 0;
  double worst = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const float speed = 10.0f * pow(100.0f, random.next()) / 60.0f;  // m per step of 1/60 s
    const float grazing = (1.0f + 88.0f * random.next()) * kPi / 180.0f, heading = 2.0f * kPi * random.next();
    const Vec3 motion = speed * Vec3(cos(grazing) * cos(heading), -sin(grazing), cos(grazing) * sin(heading));
    // On the face, on the inner edge, on its vertices' side of the rim: the lowest point of the ball meets it.
    Vec3 target(1.9f * random.next() - 0.95f, 0, 1.9f * random.next() - 0.95f);
    if (i % 3 == 1) target.z() = target.x();
    if (i % 3 == 2) target = Vec3(target.x() < 0 ? -1 : 1, 0, target.z() < 0 ? -1 : 1);
    const float expected = 0.2f + 0.6f * random.next();
    const Sweep moving{{target + Vec3(0, 0.05f, 0) - expected * motion, Quat::Identity()}, motion};
    const Impact hit = timeOfImpact({quad, still, ball, moving});
    if (!hit.touches()) {
      ++missed;
      continue;
    }
    // A ball that comes along a corner may meet the rim a little earlier than its top.
    const double error = (expected - hit.fraction) * motion.norm();
    if (i % 3 != 2) worst = std::max(worst, std::abs(error) * sin(grazing));
    EXPECT_GT(error, -1e-4) << i << " never later";
  }
  EXPECT_EQ(missed, 0);
  // Distance from the plane when stopped: the tolerance of 0.1 mm, and rounding of positions up to 17 m away.
  EXPECT_LT(worst, 2e-4);
}

TEST(TimeOfImpact, spinningBoxesNeverPassEachOther) {
  const Shape box{Box{Vec3(0.2f, 0.02f, 0.1f)}, {}}, wall{Box{Vec3(2, 0.0005f, 2)}, {}};
  const Sweep still{};
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 start = Vec3(random.next(), 1.0f + random.next(), random.next());
    const Sweep fast{{start, turn(6.0f * random.next(), random.vector() + Vec3(1e-3f, 0, 0))}, Vec3(random.next(), -4.0f, random.next()),
                     8.0f * random.vector()};
    const Impact hit = timeOfImpact({wall, still, box, fast});
    ASSERT_EQ(hit.state, Impact::State::Hit) << i;
    // At the impact the box still lies above the wall and just touches it.
    const Transform pose = fast.at(hit.fraction);
    const Mat3 r = pose.orientation.toRotationMatrix();
    const float lowest = pose.position.y() - r.row(1).cwiseAbs().dot(Vec3(0.2f, 0.02f, 0.1f));
    EXPECT_GT(lowest, 0.0005f);
    EXPECT_LT(lowest, 0.0005f + 1.5e-4f);
  }
}

TEST(TimeOfImpact, ballsAt1000MetresPerSecondDoNotPassASliveredMesh) {
  // HARD-17: aspect 1e4, zero-area, duplicate and flipped triangles over a closed plane.
  std::vector<Vec3> v;
  std::vector<uint32_t> indices;
  const auto quad = [&](float x0, float x1) {
    const uint32_t n = static_cast<uint32_t>(v.size());
    for (const Vec3& p : {Vec3(x0, 0, -1), Vec3(x0, 0, 1), Vec3(x1, 0, 1), Vec3(x1, 0, -1)}) v.push_back(p);
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(n + k);
  };
  for (int i = 0; i < 5000; ++i) quad(-1.0f + 4e-4f * float(i), i == 4999 ? 1.0f : -1.0f + 4e-4f * float(i + 1));
  for (const uint32_t k : {0u, 1u, 2u, 2u, 1u, 0u, 0u, 0u, 1u, 8u, 9u, 9u}) indices.push_back(k);
  LargeMeshResult built = buildLargeMesh(v, indices, {.thickness = 0.001f});
  ASSERT_EQ(built.error, Error::Ok);
  EXPECT_EQ(built.dropped_duplicate, 1u);
  EXPECT_EQ(built.dropped_degenerate, 2u);
  const Shape mesh{&built.mesh, {}}, ball{Sphere{0.05f}, {}};
  const Sweep still{};
  Random random;
  for (int i = 0; i < 1000; ++i) {
    // Steep enough to come down on the inside of the rim.
    const Vec3 target(1.4f * random.next() - 0.7f, 0, 1.4f * random.next() - 0.7f);
    Vec3 direction = random.vector();
    direction.y() = -0.3f - std::abs(direction.y());
    const Vec3 motion = 16.7f * direction.normalized();
    const Sweep moving{{target - 0.5f * motion, Quat::Identity()}, motion};
    const Impact hit = timeOfImpact({mesh, still, ball, moving});
    ASSERT_TRUE(hit.touches()) << i;
    EXPECT_GE(moving.at(hit.fraction).position.y(), 0.0499f);
  }
}

TEST(TimeOfImpact, meshMayMoveAndItsBackLetsThrough) {
  const auto soup = pfx_test::flatGrid(10, 0.5f);
  const LargeMesh mesh = buildLargeMesh(soup.vertices, soup.indices).mesh;
  const Shape ground{&mesh, {Vec3(0, 0.25f, 0), Quat::Identity()}}, ball{Sphere{0.25f}, {}};
  const Sweep rising{{Vec3(0, 0, 0), turn(0.4f, Vec3::UnitY())}, Vec3(0, 10, 0)};
  const Sweep still{{Vec3(0.3f, 5.5f, 0.2f), Quat::Identity()}};
  const Impact hit = timeOfImpact({ball, still, ground, rising});
  ASSERT_EQ(hit.state, Impact::State::Hit);
  EXPECT_NEAR(hit.fraction, 0.5f, 2e-5f);
  EXPECT_LT((hit.normal + Vec3::UnitY()).norm(), 1e-5f) << "from the ball, A, to the mesh, B";
  const Sweep below{{Vec3(0.3f, -5.5f, 0.2f), Quat::Identity()}, Vec3(0, 20, 0)};
  EXPECT_FALSE(timeOfImpact({ball, below, ground, Sweep{}}).touches());
}

}  // namespace
}  // namespace pfx
