// Hard cases of collision: bodies inside each other, tiny and huge ones, slivered meshes, a crushed box. Each
// at 60 Hz with four sub-steps and at 30 Hz with two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pfx/high_level/world/world.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace {

using namespace pfx;

struct Pace {
  float hertz;
  int substeps;
  float dt() const { return 1.0f / hertz; }
  int steps(float seconds) const { return static_cast<int>(std::lround(seconds * hertz)); }
};

class HardCase : public testing::TestWithParam<Pace> {
 protected:
  WorldDef def() const { return {.substeps = GetParam().substeps}; }
};

std::string paceName(const testing::TestParamInfo<Pace>& info) {
  return std::to_string(static_cast<int>(info.param.hertz)) + "HzTimes" + std::to_string(info.param.substeps);
}

INSTANTIATE_TEST_SUITE_P(, HardCase, testing::Values(Pace{60.0f, 4}, Pace{30.0f, 2}), paceName);

BodyId addGround(World& world, float half_extent) {
  return world.addBody({.name = "ground",
                        .pose = {.position = Vec3(0, -0.5f * half_extent, 0)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {{Box{Vec3(half_extent, 0.5f * half_extent, half_extent)}, {}}}});
}

float deepest(const World& world) {
  float distance = 0.0f;
  for (const Pair& pair : world.contactPairs())
    for (const ContactManifold& m : world.manifolds(pair))
      for (int i = 0; i < m.num_points; ++i) distance = std::min(distance, m.points[i].distance);
  return -distance;
}

float fastest(const World& world) {
  float speed = 0.0f;
  for (const RigidState& s : world.states()) {
    EXPECT_TRUE(s.position.allFinite() && s.linear_velocity.allFinite() && s.angular_velocity.allFinite());
    speed = std::max(speed, s.linear_velocity.norm());
  }
  return speed;
}

// HARD-07
TEST_P(HardCase, BodiesThatStartInsideEachOtherPartAndFallAsleep) {
  WorldDef d = def();
  d.sleeping = true;
  World world(d);
  addGround(world, 50.0f);
  for (int i = 0; i < 20; ++i)  // a row of boxes, each half inside the next
    world.addBody({.pose = {.position = Vec3(0.5f * static_cast<float>(i), 0.5f, 6)},
                   .shapes = {{Box{Vec3::Constant(0.5f)}, {}}}});
  for (int i = 0; i < 2; ++i)
    world.addBody({.pose = {.position = Vec3(0, 0.5f, 0)},
                   .shapes = {{Sphere{0.5f}, {}}},
                   .rolling_resistance = 0.01f});
  world.addBody({.pose = {.position = Vec3(6, 1.0f, 0)}, .shapes = {{Box{Vec3::Ones()}, {}}}});
  world.addBody({.pose = {.position = Vec3(6.1f, 1.2f, 0)}, .shapes = {{Box{Vec3::Constant(0.3f)}, {}}}});
  float depth_after_3s = 0.0f, speed = 0.0f;
  for (int i = 0; i < GetParam().steps(10.0f); ++i) {
    world.step(GetParam().dt());
    speed = std::max(speed, fastest(world));
    if (i >= GetParam().steps(3.0f)) depth_after_3s = std::max(depth_after_3s, deepest(world));
  }
  std::printf("  HARD-07 fastest body %.2f m/s (limit 5)\n", static_cast<double>(speed));
  EXPECT_LT(speed, 5.0f);
  EXPECT_LT(depth_after_3s, 5e-3f);  // a hundredth of a box
  EXPECT_EQ(world.counts().awake, 0u);
}

// A rod, pole or plank that starts with most of its length in the floor, turning or not: pushed out, never thrown.
Shape slenderShape(int kind, float half_length, float half_width) {
  if (kind == 0) return {Box{Vec3(half_length, half_width, half_width)}, {}};
  if (kind == 1) return {Capsule{half_length, half_width}, {}};
  if (kind == 2) return {Cylinder{half_length, half_width}, {}};
  return {Box{Vec3(half_length, 0.3f * half_width, 3.0f * half_width)}, {}};
}

TEST_P(HardCase, RodsThatStartInTheFloorAreNeitherThrownNorLost) {
  uint32_t random = 1;
  const auto next = [&] {
    return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
  };
  const auto vector = [&](float size) {
    const float x = next(), y = next(), z = next();
    return Vec3(size * (Vec3(x, y, z) - Vec3::Constant(0.5f)));
  };
  float fastest_tip = 0.0f;  // of any rod, as a share of the fastest that it started with
  for (int i = 0; i < 160; ++i) {
    World world(def());
    addGround(world, 50.0f);
    const float half_length = 0.5f + 3.0f * next(), half_width = 0.02f + 0.1f * next();
    const bool turns = i % 2 == 0;
    const Vec3 axis = vector(1.0f);
    BodyDef rod{.pose = {.position = Vec3(0, -half_length * (1.2f * next() - 0.2f), 0),
                         .orientation = Quat::FromTwoVectors(Vec3::UnitX(), axis)},
                .linear_velocity = turns ? vector(20.0f) : Vec3(Vec3::Zero()),
                .angular_velocity = turns ? vector(20.0f) : Vec3(Vec3::Zero()),
                .shapes = {slenderShape(i / 2 % 4, half_length, half_width)}};
    const auto tipSpeed = [&](const Vec3& v, const Vec3& w) { return v.norm() + half_length * w.norm(); };
    const float start = tipSpeed(rod.linear_velocity, rod.angular_velocity) + 10.0f;
    const BodyId id = world.addBody(rod);
    for (int k = 0; k < GetParam().steps(3.0f); ++k) {
      world.step(GetParam().dt());
      const RigidState& s = world.states()[id.index];
      ASSERT_TRUE(s.position.allFinite() && s.linear_velocity.allFinite() && s.angular_velocity.allFinite()) << i;
      fastest_tip = std::max(fastest_tip, s.linear_velocity.norm() / start);
    }
  }
  std::printf("  rods out of the floor: fastest centre %.2f of the tip speed at the start (limit 1)\n",
              static_cast<double>(fastest_tip));
  EXPECT_LT(fastest_tip, 1.0f);
}

// HARD-09. Soft contacts give way by an amount that goes with the square of the sub-step and not with the size of the
// boxes; small ones go to the island solver.
TEST_P(HardCase, PyramidsOfMillimetreBoxesStandSideBySide) {
  constexpr int kBase = 20;
  World world(def());
  addGround(world, 1.0f);
  struct Placed {
    Vec3 at;
    float edge;
  };
  std::vector<Placed> boxes;
  for (const float edge : {5e-3f, 1e-3f})
    for (int row = 0; row < kBase; ++row)
      for (int i = 0; i < kBase - row; ++i) {
        const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(kBase - row - 1)) * 1.05f * edge;
        boxes.push_back({Vec3(x, (static_cast<float>(row) + 0.5f) * edge, 10.0f * edge), edge});
        world.addBody({.pose = {.position = boxes.back().at},
                       .shapes = {{Box{Vec3::Constant(0.5f * edge)}, {}}},
                       .mass = 1e3f * edge * edge * edge});
      }
  float drift = 0.0f;
  for (int i = 0; i < GetParam().steps(10.0f); ++i) {
    world.step(GetParam().dt());
    for (size_t k = 0; k < boxes.size(); ++k)
      drift = std::max(drift, (world.states()[k + 1].position - boxes[k].at).norm() / boxes[k].edge);
  }
  std::printf("  HARD-09 boxes of 5 and 1 mm: drift %.4f of an edge (limit 0.2)\n", static_cast<double>(drift));
  EXPECT_LT(drift, 0.2f);
}

// HARD-10
TEST_P(HardCase, AKilometreSlabRestsOnFourSupportsAndABeadOnIt) {
  World world(def());
  for (const float x : {-450.0f, 450.0f})
    for (const float z : {-450.0f, 450.0f})
      world.addBody({.pose = {.position = Vec3(x, -5, z)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {{Box{Vec3::Constant(5.0f)}, {}}}});
  const BodyId slab = world.addBody(
      {.pose = {.position = Vec3(0, 5, 0)}, .shapes = {{Box{Vec3(500, 5, 500)}, {}}}, .mass = 1e9f});
  const BodyId bead = world.addBody({.pose = {.position = Vec3(100, 10.05f, 200)},
                                     .shapes = {{Sphere{0.01f}, {}}},
                                     .mass = 1e-3f,
                                     .rolling_resistance = 1e-3f});
  float sunk = 0.0f, low = 1.0f;
  for (int i = 0; i < GetParam().steps(10.0f); ++i) {
    world.step(GetParam().dt());
    sunk = std::max(sunk, 5.0f - world.states()[slab.index].position.y());
    low = std::min(low,
                   world.states()[bead.index].position.y() - world.states()[slab.index].position.y() - 5.01f);
  }
  std::printf("  HARD-10 slab sunk by %.2e m (limit 0.01), bead low by %.1e m\n", static_cast<double>(sunk),
              static_cast<double>(-low));
  EXPECT_LT(sunk, 0.01f);
  EXPECT_GT(low, -0.005f);
  EXPECT_LT(world.states()[bead.index].linear_velocity.norm(), 1e-3f);
}

// HARD-17: slivers of aspect 1e4, triangles without area, given twice, and facing the other way.
LargeMesh sliveredSheet(float half_extent) {
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  constexpr int kStrips = 400;
  for (int i = 0; i <= kStrips; ++i)
    for (const float z : {-1.0f, 1.0f})
      vertices.push_back(
          Vec3(half_extent * (2.0f * static_cast<float>(i) / kStrips - 1.0f), 0, 20.0f * half_extent * z));
  for (uint32_t i = 0; i < kStrips; ++i) {
    const uint32_t a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    const std::initializer_list<uint32_t> quad = {a, b, c, c, b, d};
    indices.insert(indices.end(), quad);
    if (i % 7 == 0) indices.insert(indices.end(), quad);                // once more
    if (i % 5 == 0) indices.insert(indices.end(), {a, c, b});           // facing down
    if (i % 3 == 0) indices.insert(indices.end(), {a, a, b, a, c, c});  // no area
  }
  return buildLargeMesh(vertices, indices).mesh;
}

TEST_P(HardCase, NoBallAtAThousandMetresPerSecondPassesASliveredMesh) {
  World world({.gravity = Vec3::Zero(), .substeps = GetParam().substeps});
  constexpr float kHalf = 10.0f;
  world.addBody({.motion_type = MotionType::Fixed, .shapes = {{world.keep(sliveredSheet(kHalf)), {}}}});
  std::vector<BodyId> balls;
  uint32_t random = 1;
  const auto next = [&] {
    return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
  };
  for (int i = 0; i < 1000; ++i) {
    const float x = 0.9f * kHalf * (2.0f * next() - 1.0f), z = kHalf * (2.0f * next() - 1.0f),
                y = 2.0f + 10.0f * next();
    const float slope = 0.2f * (2.0f * next() - 1.0f);
    balls.push_back(world.addBody({.pose = {.position = Vec3(x, y, z)},
                                   .linear_velocity = 1000.0f * Vec3(slope * 0.1f, -1.0f, slope).normalized(),
                                   .shapes = {{Sphere{0.05f}, {}}},
                                   .filter_self = 2u,
                                   .filter_target = 1u}));
  }
  for (int i = 0; i < GetParam().steps(0.5f); ++i) world.step(GetParam().dt());
  int passed = 0;
  for (const BodyId& id : balls) passed += world.states()[id.index].position.y() < -0.05f;
  std::printf("  HARD-17 passed: %d of 1000\n", passed);
  EXPECT_EQ(passed, 0);
}

LargeMesh gridSheet(float half_extent, uint32_t cells) {
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  const auto place = [&](uint32_t i) {
    return half_extent * (2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f);
  };
  for (uint32_t i = 0; i <= cells; ++i)
    for (uint32_t k = 0; k <= cells; ++k) vertices.push_back(Vec3(place(i), 0, place(k)));
  for (uint32_t i = 0; i < cells; ++i)
    for (uint32_t k = 0; k < cells; ++k) {
      const uint32_t a = i * (cells + 1) + k, b = a + 1, c = a + cells + 1, d = c + 1;
      indices.insert(indices.end(), {a, b, c, c, b, d});
    }
  return buildLargeMesh(vertices, indices).mesh;
}

// A thin disc that slides and spins keeps to the floor, and loses no more spin than pressure at its rim alone takes. A
// contact from elsewhere on a wide floor would stop it at once.
TEST(Puck, AThinDiscThatSpinsIsOnlySlowedByFriction) {
  constexpr float kRadius = 0.1f, kHalfLength = 0.005f, kFriction = 0.3f, kGravity = 9.81f;
  for (const bool on_mesh : {false, true})
    for (const float speed : {0.0f, 2.0f}) {
      World world({.gravity = Vec3(0, -kGravity, 0)});
      Shape floor{Box{Vec3(50, 1, 50)}, {Vec3(0, -1, 0), Quat::Identity()}};
      if (on_mesh) floor = {world.keep(gridSheet(5.0f, 40)), {}};
      world.addBody({.motion_type = MotionType::Fixed, .shapes = {floor}, .friction = kFriction});
      const Quat upright(Eigen::AngleAxisf(0.5f * static_cast<float>(M_PI), Vec3::UnitZ()));
      const BodyId puck = world.addBody({.pose = {.position = Vec3(0, kHalfLength, 0)},
                                         .linear_velocity = Vec3(speed, 0, 0),
                                         .angular_velocity = Vec3(0, 30, 0),
                                         .shapes = {{Cylinder{kHalfLength, kRadius}, {Vec3::Zero(), upright}}},
                                         .restitution = 0.0f,
                                         .friction = kFriction});
      float lifted = 0.0f, spin_lost = 0.0f;
      for (int i = 0; i < 30; ++i) {
        const float before = world.states()[puck.index].angular_velocity.y();
        world.step(1.0f / 60.0f);
        const RigidState& s = world.states()[puck.index];
        lifted = std::max(lifted, std::abs(s.position.y() - kHalfLength));
        spin_lost = std::max(spin_lost, before - s.angular_velocity.y());
      }
      // All pressure at the rim brakes the spin with mu m g R on m R^2 / 2.
      const float most = 2.0f * kFriction * kGravity / kRadius / 60.0f;
      std::printf("  puck at %.0f m/s on a %s: off the floor %.1e m, spin lost in a step %.2f rad/s (limit %.2f)\n",
                  static_cast<double>(speed), on_mesh ? "mesh" : "box", static_cast<double>(lifted),
                  static_cast<double>(spin_lost), static_cast<double>(most));
      EXPECT_LT(lifted, 1e-4f);
      EXPECT_LT(spin_lost, 1.05f * most);
    }
}

// HARD-18
TEST_P(HardCase, ABoxCrushedByAPistonRecovers) {
  World world(def());
  addGround(world, 20.0f);
  const BodyId box =
      world.addBody({.pose = {.position = Vec3(0, 0.5f, 0)}, .shapes = {{Box{Vec3::Constant(0.5f)}, {}}}});
  const BodyId bystander =
      world.addBody({.pose = {.position = Vec3(5, 0.5f, 0)}, .shapes = {{Box{Vec3::Constant(0.5f)}, {}}}});
  constexpr float kSpeed = 0.5f;  // m/s
  float y = 1.3f;                 // of the lower side of the piston
  const BodyId piston = world.addBody({.pose = {.position = Vec3(0, y + 0.5f, 0)},
                                       .motion_type = MotionType::Keyframe,
                                       .shapes = {{Box{Vec3(2, 0.5f, 2)}, {}}}});
  for (int i = 0; i < GetParam().steps(1.0f); ++i) world.step(GetParam().dt());
  const Vec3 at_rest = world.states()[bystander.index].position;
  float ejected = 0.0f;
  for (int i = 0; i < GetParam().steps(6.0f); ++i) {
    const float t = static_cast<float>(i) * GetParam().dt();
    y = std::max(0.6f, 1.3f - kSpeed * t);
    if (t > 2.0f) y = std::min(3.0f, 0.6f + kSpeed * (t - 2.0f));
    world.moveKeyframe(piston, {.position = Vec3(0, y + 0.5f, 0)}, GetParam().dt());
    world.step(GetParam().dt());
    ejected = std::max(ejected, fastest(world));
  }
  const RigidState& s = world.states()[box.index];
  std::printf("  HARD-18 fastest %.2f of the piston (limit 5), box off its rest by %.1e m\n",
              static_cast<double>(ejected / kSpeed), static_cast<double>(std::abs(s.position.y() - 0.5f)));
  EXPECT_LT(ejected, 5.0f * kSpeed);
  EXPECT_NEAR(s.position.y(), 0.5f, 0.01f);
  EXPECT_LT(s.linear_velocity.norm(), 0.01f);
  EXPECT_LT((world.states()[bystander.index].position - at_rest).norm(), 1e-3f);
}

// 400 pairs of four points in the first step, and the same bits for any number of workers.
TEST(Plate, APlateOnFourHundredBoxesGetsAllItsContactsInTheFirstStep) {
  uint64_t first_hash = 0;
  for (const int workers : {1, 2, 3, 4}) {
    World world({.workers = workers});
    addGround(world, 40.0f);
    for (int i = 0; i < 20; ++i)
      for (int k = 0; k < 20; ++k)
        world.addBody(
            {.pose = {.position = Vec3(static_cast<float>(i) - 9.5f, 0.25f, static_cast<float>(k) - 9.5f)},
             .shapes = {{Box{Vec3::Constant(0.25f)}, {}}}});
    const BodyId plate = world.addBody(
        {.pose = {.position = Vec3(0, 0.6f, 0)}, .shapes = {{Box{Vec3(10, 0.1f, 10)}, {}}}, .mass = 100.0f});
    world.step(1.0f / 60.0f);
    uint32_t pairs = 0, points = 0;
    for (const Pair& pair : world.contactPairs()) {
      if (pair.body_a != plate.index && pair.body_b != plate.index) continue;
      for (const ContactManifold& m : world.manifolds(pair))
        ++pairs, points += static_cast<uint32_t>(m.num_points);
    }
    EXPECT_EQ(pairs, 400u);
    EXPECT_EQ(points, 1600u);
    for (int i = 0; i < 30; ++i) world.step(1.0f / 60.0f);
    if (workers == 1) first_hash = world.stateHash();
    EXPECT_EQ(world.stateHash(), first_hash) << workers << " workers";
    EXPECT_NEAR(world.states()[plate.index].position.y(), 0.6f, 1e-3f);
  }
}

}  // namespace
