// Bodies on meshes whose vertices move, against closed forms (ACC-27), with what was measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace {

using namespace pfx;

constexpr float kGravity = 9.81f;

// A box at rest on a flat sheet of 2 x 8 x 8 triangles, whose vertices the test moves.
struct BoxOnSheet {
  struct Setting {
    float friction = 0.5f;
    float dt = 1.0f / 60.0f;  // s
    int substeps = 4;
  };

  explicit BoxOnSheet(const Setting& s)
      : world({.gravity = Vec3(0, -kGravity, 0), .substeps = s.substeps}), dt(s.dt) {
    constexpr int kCells = 8;
    std::vector<uint32_t> indices;
    for (int i = 0; i <= kCells; ++i)
      for (int k = 0; k <= kCells; ++k) {
        vertices.push_back(Vec3(2.0f * static_cast<float>(i) - 8.0f, 0, 2.0f * static_cast<float>(k) - 8.0f));
        if (i == kCells || k == kCells) continue;
        const auto at = [&](int di, int dk) { return static_cast<uint32_t>((i + di) * (kCells + 1) + k + dk); };
        indices.insert(indices.end(), {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)});
      }
    mesh = world.keep(buildLargeMesh(vertices, indices, {.thickness = 1.0f}).mesh);
    world.addBody({.motion_type = MotionType::Fixed,
                   .shapes = {Shape{mesh, {}}},
                   .restitution = 0.0f,
                   .friction = s.friction});
    world.addBody({.pose = {.position = Vec3(0.3f, 0.2f, 0.2f)},
                   .shapes = {Shape{Box{Vec3(0.5f, 0.2f, 0.5f)}, {}}},
                   .restitution = 0.0f,
                   .friction = s.friction});
    for (int i = 0; i < 60; ++i) world.step(dt);
  }

  void step() {
    world.deformMesh(mesh, vertices, dt);
    world.step(dt);
  }
  void raiseTo(float y) {
    for (Vec3& v : vertices) v.y() = y;
    step();
  }
  const RigidState& box() const { return world.states()[1]; }

  World world;
  float dt;
  const LargeMesh* mesh = nullptr;
  std::vector<Vec3> vertices;
};

// (a) N = m (g + a): 11.81 N/kg for a = 2 m/s^2, as the momentum that the box gains besides what gravity takes.
TEST(MovingMesh, AFloorThatAcceleratesUpwardsPressesWithElevenPointEightOneNewtonAKilogram) {
  BoxOnSheet scene({});
  float before = 0.0f;
  for (int i = 1; i <= 60; ++i) {
    const float t = static_cast<float>(i) * scene.dt;
    scene.raiseTo(t * t);
    if (i == 30) before = scene.box().linear_velocity.y();
  }
  const float gained = scene.box().linear_velocity.y() - before;
  const double force = static_cast<double>(gained / (30.0f * scene.dt) + kGravity);
  std::printf("floor accelerating up at 2 m/s^2: %.4f N/kg, of 11.81 (%+.2e)\n", force, force / 11.81 - 1.0);
  EXPECT_NEAR(force, 11.81, 0.01 * 11.81);
}

// (b) On a surface that runs at 1 m/s a box gains mu g t, until it goes with it after 1 / (mu g); until then it has
// slipped 1 / (2 mu g).
TEST(MovingMesh, AConveyorAcceleratesABoxWithMuTimesG) {
  constexpr double kAcceleration = 0.3 * static_cast<double>(kGravity);
  for (const int substeps : {4, 8}) {
    BoxOnSheet scene({.friction = 0.3f, .substeps = substeps});
    const float start = scene.box().position.x();
    const double dt = static_cast<double>(scene.dt);
    double worst = 0.0;
    for (int i = 1; i <= 60; ++i) {
      for (Vec3& v : scene.vertices) v.x() += scene.dt;
      scene.step();
      const double expected = std::min(1.0, kAcceleration * dt * i);
      const bool has_kink = i >= 20 && i <= 21;  // it arrives at 20.4 steps
      if (i >= 5 && !has_kink) worst = std::max(worst, std::abs(scene.box().linear_velocity.x() / expected - 1.0));
    }
    const double slip = 1.0 - static_cast<double>(scene.box().position.x() - start);  // m, of belt that ran through
    const double exact = 0.5 / kAcceleration;
    std::printf("conveyor at 1 m/s, %d sub-steps: speed within %.2e of mu g t, slip %.5f m, of %.5f (%+.2e)\n", substeps,
                worst, slip, exact, slip / exact - 1.0);
    EXPECT_LT(worst, 0.01);
    EXPECT_NEAR(slip, exact, 0.002 * exact);
  }
}

// A surface at A (1 - cos w t) with A w^2 = share * g.
struct Swing {
  static constexpr double kFrequency = 3.0, kG = static_cast<double>(kGravity);  // rad/s, m/s^2
  double share;
  double amplitude() const { return share * kG / (kFrequency * kFrequency); }
  double at(double t) const { return amplitude() * (1.0 - std::cos(kFrequency * t)); }
};

// m: what lies on it flies from where it falls faster than g; the widest gap until they meet again.
double widestGap(const Swing& swing) {
  const double left = std::acos(-1.0 / swing.share) / Swing::kFrequency;
  const double speed = swing.amplitude() * Swing::kFrequency * std::sin(Swing::kFrequency * left);
  double widest = 0.0;
  for (int i = 1; i < 20000; ++i) {
    const double t = 1e-4 * i, gap = swing.at(left) + speed * t - 0.5 * Swing::kG * t * t - swing.at(left + t);
    if (gap < 0.0) break;
    widest = std::max(widest, gap);
  }
  return widest;
}

double widestGapOfTheBox(const Swing& swing, float dt) {
  BoxOnSheet scene({.dt = dt});
  double widest = 0.0;
  for (int i = 1; dt * static_cast<float>(i) < 1.7f; ++i) {  // to the crest after a second, and down again
    scene.raiseTo(static_cast<float>(swing.at(static_cast<double>(dt) * i)));
    // The solver has moved the surface on by one step of its velocity.
    const double surface = swing.at(static_cast<double>(dt) * (i + 1));
    widest = std::max(widest, static_cast<double>(scene.box().position.y()) - 0.2 - surface);
  }
  return widest;
}

// (c) A box rides on the crest of a wave until A w^2 exceeds g; from there it flies, and the widest gap tells from which
// amplitude the engine took it to fly. A mesh that is moved once a step is known at the ends of steps only: the target of 1 %
// is met at 240 Hz, and missed by 0.4 points at 120 Hz and by 1.6 at 60 Hz.
TEST(MovingMesh, AWaveLetsGoOfABoxWhereItsCrestFallsFasterThanG) {
  for (const float rate : {60.0f, 120.0f, 240.0f}) {
    const Swing swing{1.2};
    const double gap = widestGapOfTheBox(swing, 1.0f / rate), rides = widestGapOfTheBox({0.95}, 1.0f / rate);
    double low = 1.0, high = 4.0;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (widestGap({middle}) < gap ? low : high) = middle;
    }
    const double error = low / swing.share - 1.0;
    std::printf("wave of A w^2 = 1.2 g at %3.0f Hz: gap %.4f m, of %.4f; lift-off amplitude %+.2e; gap at 0.95 g %.4f m\n",
                rate, gap, widestGap(swing), error, rides);
    EXPECT_LT(rides, 1.0 / static_cast<double>(rate));
    EXPECT_LT(std::abs(error), rate > 120.0f ? 0.01 : rate > 60.0f ? 0.015 : 0.03);
  }
}

}  // namespace
