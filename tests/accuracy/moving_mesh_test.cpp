// Bodies on meshes whose vertices move, against closed forms (ACC-27), with what was measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;
constexpr float kGravity = 9.81f;

// A box at rest on a flat sheet of 2 x 8 x 8 triangles, whose vertices the test moves.
struct BoxOnSheet {
  explicit BoxOnSheet(float friction) : world([] {
      WorldDef def;
      def.gravity = Vec3(0, -kGravity, 0);
      return def;
    }()) {
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
                   .friction = friction});
    world.addBody({.pose = {.position = Vec3(0.3f, 0.2f, 0.2f)},
                   .shapes = {Shape{Box{Vec3(0.5f, 0.2f, 0.5f)}, {}}},
                   .restitution = 0.0f,
                   .friction = friction});
    for (int i = 0; i < 60; ++i) world.step(kDt);
  }

  void step() {
    world.deformMesh(mesh, vertices, kDt);
    world.step(kDt);
  }
  void raiseTo(float y) {
    for (Vec3& v : vertices) v.y() = y;
    step();
  }
  const RigidState& box() const { return world.states()[1]; }

  // N, mean over the last sub-step, that the sheet presses on the box with.
  float pressure() const {
    float sum = 0.0f;
    for (const Pair& pair : world.contactPairs())
      for (const ContactManifold& m : world.manifolds(pair))
        for (int i = 0; i < m.num_points; ++i) sum += m.points[i].normal_impulse;
    return sum * static_cast<float>(world.def().substeps) / kDt;
  }

  World world;
  const LargeMesh* mesh = nullptr;
  std::vector<Vec3> vertices;
};

// (a) N = m (g + a): 11.81 N/kg for a = 2 m/s^2.
TEST(MovingMesh, AFloorThatAcceleratesUpwardsPressesWithElevenPointEightOneNewtonAKilogram) {
  BoxOnSheet scene(0.5f);
  double force = 0.0;
  for (int i = 1; i <= 60; ++i) {
    const float t = static_cast<float>(i) * kDt;
    scene.raiseTo(t * t);
    if (i > 30) force += static_cast<double>(scene.pressure()) / 30.0;
  }
  std::printf("floor accelerating up at 2 m/s^2: %.4f N/kg, of 11.81 (%+.2e)\n", force, force / 11.81 - 1.0);
  EXPECT_NEAR(force, 11.81, 0.01 * 11.81);
}

// (b) On a surface that runs at 1 m/s a box gains mu g t, until it goes with it after 1 / (mu g); until then it has
// slipped 1 / (2 mu g).
TEST(MovingMesh, AConveyorAcceleratesABoxWithMuTimesG) {
  constexpr float kFriction = 0.3f;
  BoxOnSheet scene(kFriction);
  const float start = scene.box().position.x();
  double worst = 0.0;
  for (int i = 1; i <= 60; ++i) {
    for (Vec3& v : scene.vertices) v.x() += kDt;
    scene.step();
    const double expected = std::min(1.0, static_cast<double>(kFriction * kGravity * kDt) * i);
    const bool has_kink = i >= 20 && i <= 21;  // it arrives at 20.4 steps
    if (i >= 5 && !has_kink) worst = std::max(worst, std::abs(scene.box().linear_velocity.x() / expected - 1.0));
  }
  const double slip = 1.0 - static_cast<double>(scene.box().position.x() - start);  // m, of belt that ran through
  const double expected = 0.5 / static_cast<double>(kFriction * kGravity);
  std::printf("conveyor at 1 m/s: speed within %.2e of mu g t, slip %.5f m, of %.5f (%+.2e)\n", worst, slip, expected,
              slip / expected - 1.0);
  EXPECT_LT(worst, 0.01);
  EXPECT_NEAR(slip, expected, 0.02 * expected);
}

// Whether the surface lets go of the box when it moves by A cos(w t) with A w^2 = share * g.
bool letsGo(float share) {
  constexpr float kFrequency = 3.0f;  // rad/s
  BoxOnSheet scene(0.5f);
  const float amplitude = share * kGravity / (kFrequency * kFrequency);
  for (int i = 1; i <= 200; ++i) {
    const float angle = kFrequency * kDt * static_cast<float>(i);
    scene.raiseTo(amplitude * (1.0f - std::cos(angle)));
    if (scene.pressure() == 0.0f) return true;
  }
  return false;
}

// (c) A box rides on the crest of a wave until A w^2 exceeds g.
TEST(MovingMesh, AWaveLetsGoOfABoxWhenItsCrestFallsFasterThanG) {
  float rides = 0.8f, flies = 1.2f;
  ASSERT_FALSE(letsGo(rides));
  ASSERT_TRUE(letsGo(flies));
  for (int i = 0; i < 8; ++i) {
    const float middle = 0.5f * (rides + flies);
    (letsGo(middle) ? flies : rides) = middle;
  }
  std::printf("crest lets go of a box at A w^2 = %.4f g\n", 0.5 * (rides + flies));
  EXPECT_NEAR(0.5f * (rides + flies), 1.0f, 0.01f);
}

}  // namespace
