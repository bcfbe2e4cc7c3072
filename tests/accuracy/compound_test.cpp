// ACC-34: compounds against closed forms and against the single body that they make up.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/rigid_body/mass_properties.h"
#include "pfx/high_level/world/world.h"

namespace pfx {
namespace {

constexpr double kRelative = 1e-5;

// Point masses: inertia about the origin of the frame is that of the balls and that of their places.
TEST(Compounds, aRingOfBallsHasTheClosedForm) {
  constexpr int kBalls = 24;
  constexpr float kRing = 2.0f, kBall = 0.1f, kDensity = 700.0f;
  std::vector<Shape> shapes;
  for (int i = 0; i < kBalls; ++i) {
    const float a = 2.0f * kPi * static_cast<float>(i) / kBalls;
    shapes.push_back({Sphere{kBall}, {Vec3(kRing * cos(a), kRing * sin(a), 0.0f), Quat::Identity()}});
  }
  const MassProperties p = massProperties(std::span<const Shape>(shapes), kDensity);
  const double m = kDensity * 4.0 / 3.0 * M_PI * std::pow(kBall, 3), own = 0.4 * m * kBall * kBall;
  const double through = kBalls * (own + m * kRing * kRing),
               across = kBalls * (own + 0.5 * m * kRing * kRing);
  EXPECT_NEAR(p.mass, kBalls * m, kRelative * kBalls * m);
  EXPECT_LT(p.center.norm(), 1e-6f);
  EXPECT_NEAR(p.inertia(2, 2), through, kRelative * through);
  EXPECT_NEAR(p.inertia(0, 0), across, kRelative * across);
  EXPECT_NEAR(p.inertia(1, 1), across, kRelative * across);
  EXPECT_NEAR(p.inertia(0, 1), 0.0, kRelative * across);
}

TEST(Compounds, anLOfTwoBoxesHasTheClosedForm) {
  // A bar of 2 x 1 x 1 m along X with a cube on its end: 2 m at (0, 0, 0) and m at (0.5, 1, 0).
  const std::vector<Shape> shapes = {
      {Box{Vec3(1.0f, 0.5f, 0.5f)}, {}},
      {Box{Vec3(0.5f, 0.5f, 0.5f)}, {Vec3(0.5f, 1.0f, 0.0f), Quat::Identity()}}};
  const MassProperties p = massProperties(std::span<const Shape>(shapes), 1.0f);
  EXPECT_NEAR(p.mass, 3.0, 3.0 * kRelative);
  EXPECT_NEAR(p.center.x(), 0.5 / 3.0, kRelative);
  EXPECT_NEAR(p.center.y(), 1.0 / 3.0, kRelative);
  // Reduced mass 2/3 at a distance of (0.5, 1).
  const double bar_x = 2.0 / 12.0 * 2.0, bar_y = 2.0 / 12.0 * 5.0, cube = 1.0 / 6.0, reduced = 2.0 / 3.0;
  EXPECT_NEAR(p.inertia(0, 0), bar_x + cube + reduced, kRelative);
  EXPECT_NEAR(p.inertia(1, 1), bar_y + cube + reduced * 0.25, kRelative);
  EXPECT_NEAR(p.inertia(2, 2), bar_y + cube + reduced * 1.25, kRelative);
  EXPECT_NEAR(p.inertia(0, 1), -reduced * 0.5, kRelative);
}

TEST(Compounds, aThousandBallsHaveTheSumOfTheirPlaces) {
  std::vector<Shape> shapes;
  double square = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at(static_cast<float>(i % 10) - 4.5f, static_cast<float>(i / 10 % 10) - 4.5f,
                  static_cast<float>(i / 100) - 4.5f);
    shapes.push_back({Sphere{0.3f}, {at, Quat::Identity()}});
    square += static_cast<double>(at.x()) * at.x();
  }
  const MassProperties p = massProperties(std::span<const Shape>(shapes), 1.0f);
  const double m = 4.0 / 3.0 * M_PI * 0.027, each = 1000.0 * 0.4 * m * 0.09 + 2.0 * m * square;
  EXPECT_NEAR(p.mass, 1000.0 * m, kRelative * 1000.0 * m);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(p.inertia(k, k), each, kRelative * each);
}

std::vector<Shape> cubeOf(int n) {
  std::vector<Shape> parts;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 cell(static_cast<float>(i % n), static_cast<float>(i / n % n),
                    static_cast<float>(i / (n * n)));
    const float size = 1.0f / static_cast<float>(n);
    parts.push_back({Box{Vec3::Constant(0.5f * size)},
                     {size * (cell - Vec3::Constant(0.5f * static_cast<float>(n - 1))), Quat::Identity()}});
  }
  return parts;
}

struct Start {
  Transform start;
  Vec3 velocity = Vec3::Zero();
  float friction = 0.5f;
  float seconds = 1.0f;
};

RigidState run(const std::vector<Shape>& shapes, const Start& r) {
  World world;
  world.addBody({.pose = {.position = Vec3(0, -1, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {{Box{Vec3(50, 1, 50)}, {}}},
                 .restitution = 0.0f,
                 .friction = r.friction});
  const BodyId id = world.addBody({.pose = r.start,
                                   .linear_velocity = r.velocity,
                                   .shapes = shapes,
                                   .restitution = 0.0f,
                                   .friction = r.friction});
  for (int i = 0; i < static_cast<int>(60.0f * r.seconds); ++i) world.step(1.0f / 60.0f);
  return world.state(id);
}

// m and rad, at the end of the run.
void expectSame(const char* what, const Start& start) {
  const RigidState a = run(cubeOf(1), start), b = run(cubeOf(8), start);
  const float off = (a.position - b.position).norm(), turned = a.orientation.angularDistance(b.orientation);
  std::printf("  ACC-34 512 boxes, %s: off by %.1e m and %.1e rad (limit 1e-3)\n", what, static_cast<double>(off),
              static_cast<double>(turned));
  EXPECT_LT(off, 1e-3f) << what;
  EXPECT_LT(turned, 1e-3f) << what;
}

TEST(Compounds, aCubeOf512BoxesDropsSlidesAndTumblesAsTheOneBoxDoes) {
  const auto turned = [](float angle, const Vec3& axis) { return Quat(Eigen::AngleAxisf(angle, axis)); };
  expectSame("dropped", {.start = {.position = Vec3(0, 1.0f, 0)}});
  expectSame("dropped, turned by 30 degrees", {.start = {Vec3(0, 1.0f, 0), turned(0.5235988f, Vec3::UnitY())}});
  expectSame("sliding", {.start = {.position = Vec3(0, 0.5f, 0)}, .velocity = Vec3(3, 0, 1), .friction = 0.2f});
  // On its edge by 30 degrees: it tips over within 0.3 s.
  const Start tip{.start = {Vec3(0, 0.6831f, 0), turned(0.5235988f, Vec3::UnitZ())}, .seconds = 0.3f};
  expectSame("tipping over", tip);
}

}  // namespace
}  // namespace pfx
