// Particles against closed forms and conservation laws.
#include "pfx/high_level/particles/particle_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "pfx/high_level/particles/particle_builder.h"
#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kDt = 1.0f / 60.0f;
constexpr double kGravity = 9.8;

ParticleDef oneParticle(const Vec3& position) { return {.name = "one", .positions = {position}, .masses = {0.1f}}; }

BodyId addGround(World& world, float friction = 0.6f) {
  return world.addBody({.name = "ground",
                        .pose = {.position = Vec3(0, -1, 0)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {Shape{Box{Vec3(50, 1, 50)}, {}}},
                        .friction = friction});
}

void run(World& world, float seconds) {
  const int steps = static_cast<int>(std::lround(seconds / kDt));
  for (int i = 0; i < steps; ++i) world.step(kDt);
}

// With n sub-steps of h seconds the fall is longer than g t^2 / 2 by g t h / 2.
TEST(Particles, AFreeParticleFallsAsABodyDoes) {
  World world;
  const ParticlesId id = world.addParticles(oneParticle(Vec3(1, 10, 2)));
  run(world, 1.0f);
  const float h = kDt / 8.0f;
  EXPECT_NEAR(world.particles(id).positions()[0].y(), 10.0 - kGravity * (0.5 + 0.5 * h), 1e-4);
  EXPECT_NEAR(world.particles(id).velocities()[0].y(), -kGravity, 2e-3);  // 480 roundings of positions near 10 m
}

// Small swings: T = 2 pi sqrt(l / g) (1 + a^2 / 16).
TEST(Particles, AParticleOnAThreadSwingsWithThePeriodOfAPendulum) {
  World world;
  ParticleDef def{.name = "pendulum",
                  .positions = {Vec3(0, 0, 0), Vec3(std::sin(0.1f), -std::cos(0.1f), 0)},
                  .masses = {0.0f, 1.0f},
                  .strands = {{.particles = {0, 1}}}};
  const ParticlesId id = world.addParticles(def);
  double last_x = 1.0, crossings = 0.0, first = 0.0, last = 0.0;
  for (int i = 1; i <= 60 * 10; ++i) {
    world.step(kDt);
    const double x = world.particles(id).positions()[1].x();
    if (last_x > 0.0 && x <= 0.0) {
      last = (i - 1 + last_x / (last_x - x)) * kDt;
      if (crossings++ == 0.0) first = last;
    }
    last_x = x;
  }
  const double period = 2.0 * std::numbers::pi * std::sqrt(1.0 / kGravity) * (1.0 + 0.01 / 16.0);
  ASSERT_GE(crossings, 4.0);
  EXPECT_NEAR((last - first) / (crossings - 1.0), period, 1e-3 * period);
  EXPECT_LT(world.particles(id).maxStrain(), 1e-4f);
}

TEST(Particles, AThreadHoldsItsLengthWithAThousandTimesItsMassAtTheEnd) {
  World world;
  ParticleDef def{.name = "thread"};
  addRope(def, {.to = Vec3(1, 0, 0), .particles = 32, .mass = 0.032f});
  def.masses.front() = 0.0f;
  def.masses.back() = 32.0f;
  const ParticlesId id = world.addParticles(def);
  float worst = 0.0f;
  for (int i = 0; i < 180; ++i) {
    world.step(kDt);
    worst = std::max(worst, world.particles(id).maxStrain());
  }
  EXPECT_LT(worst, 0.005f);
  EXPECT_GT((world.particles(id).positions()[31] - world.particles(id).positions()[0]).norm(), 0.99f);
}

TEST(Particles, AnchoredParticlesAreExactlyWhereTheirBodyIs) {
  World world;
  const BodyId head = world.addBody({.name = "head",
                                     .pose = {.position = Vec3(0, 2, 0)},
                                     .motion_type = MotionType::Keyframe,
                                     .shapes = {Shape{Sphere{0.2f}, {}}}});
  ParticleDef def{.name = "hair"};
  addRope(def, {.from = Vec3(0.21f, 2, 0), .to = Vec3(1, 2, 0), .particles = 16, .mass = 0.01f});
  const Vec3 local(0.21f, 0.0f, 0.0f);
  def.anchors = {{.particle = 0, .body = head.index, .local = local}};
  const ParticlesId id = world.addParticles(def);
  for (int i = 0; i < 120; ++i) {
    const float t = static_cast<float>(i) * kDt;
    const Quat turn(Eigen::AngleAxisf(std::sin(5.0f * t), Vec3(0.6f, 0.8f, 0.0f)));
    world.moveKeyframe(head, {Vec3(std::sin(9.0f * t), 2.0f, 0.3f * std::cos(7.0f * t)), turn}, kDt);
    world.step(kDt);
    const Vec3 root = world.states()[head.index].pose().apply(local);
    ASSERT_EQ(world.particles(id).positions()[0], root) << "step " << i;
  }
  EXPECT_LT(world.particles(id).maxStrain(), 0.01f);
}

// A rope that is thrown at a free ball, and one that hangs on it: what one loses the other gains.
TEST(Particles, ContactAndAnchorsKeepTheMomentumOfParticlesAndBody) {
  for (const bool is_anchored : {false, true}) {
    WorldDef def;
    def.gravity = Vec3::Zero();
    World world(def);
    const BodyId ball =
        world.addBody({.name = "ball", .shapes = {Shape{Sphere{0.5f}, {}}}, .mass = 2.0f, .friction = 0.8f});
    ParticleDef rope{.name = "rope"};
    addRope(rope, {.from = Vec3(-2, 0.1f, -1), .to = Vec3(-2, 0.2f, 1), .particles = 33, .mass = 1.0f});
    rope.velocities.assign(33, Vec3(6, 0, 0));
    if (is_anchored) {
      addRope(rope, {.from = Vec3(0.5f, 0, 0), .to = Vec3(1.5f, 0, 0), .particles = 11, .mass = 0.3f});
      rope.velocities.resize(44, Vec3(0, 3, 0));
      rope.anchors = {{.particle = 33, .body = ball.index, .local = Vec3(0.5f, 0, 0)}};
    }
    const ParticlesId id = world.addParticles(rope);
    const Vec3 before = world.particles(id).momentum();
    run(world, 1.0f);
    const Vec3 body = 2.0f * world.states()[ball.index].linear_velocity;
    const Vec3 after = world.particles(id).momentum() + body;
    EXPECT_GT(body.norm(), 1.0f) << "the rope must hit the ball, or the test proves nothing";
    // Velocities are differences of positions of a few metres over 2 ms: 1e-4 m/s of rounding each, added up.
    EXPECT_LT((after - before).norm(), 5e-3f) << "anchored: " << is_anchored;
  }
}

TEST(Particles, AClothCarriesABallAndTheBallRestsOnIt) {
  World world;
  const BodyId ball = world.addBody(
      {.name = "ball", .pose = {.position = Vec3(0, 0.7f, 0)}, .shapes = {Shape{Sphere{0.4f}, {}}}, .mass = 3.0f});
  ParticleDef def{.name = "sheet", .settings = {.damping = 0.5f}};
  addCloth(def, {.corner = Vec3(-1, 0, -1), .along = Vec3(2, 0, 0), .across = Vec3(0, 0, 2), .columns = 20, .rows = 20, .mass = 0.8f});
  for (Vec3& p : def.positions) p.y() = 0.3f * (p.z() * p.z() - 1.0f);  // hangs between its edges
  for (int i = 0; i < 20; ++i) def.masses[i] = def.masses[19 * 20 + i] = 0.0f;
  const ParticlesId id = world.addParticles(def);
  run(world, 4.0f);
  const RigidState& s = world.states()[ball.index];
  EXPECT_GT(s.position.y(), -0.5f);
  EXPECT_LT(s.linear_velocity.norm(), 0.1f);
  EXPECT_LT(world.particles(id).maxStrain(), 0.02f);
}

TEST(Particles, ASoftBodyKeepsItsVolume) {
  World world;
  addGround(world);
  ParticleDef def{.name = "jelly"};
  addSoftBox(def, {.center = Vec3(0, 1.0f, 0),
                   .half_extent = Vec3::Constant(0.5f),
                   .cells = {5, 5, 5},
                   .mass = 20.0f,
                   .edge_compliance = 1e-4f});
  const ParticlesId id = world.addParticles(def);
  float least = 1.0f, most = 1.0f, lowest = 10.0f;
  for (int i = 0; i < 180; ++i) {
    world.step(kDt);
    const float volume = world.particles(id).relativeVolume();
    least = std::min(least, volume), most = std::max(most, volume);
    for (const Vec3& p : world.particles(id).positions()) lowest = std::min(lowest, p.y());
  }
  EXPECT_GT(least, 0.98f);
  EXPECT_LT(most, 1.02f);
  EXPECT_GT(lowest, 0.0f);  // the radius is kept
}

// On a slope a particle slides when tan(slope) exceeds the coefficient of friction, with g (sin - mu cos).
TEST(Particles, FrictionIsThatOfCoulomb) {
  for (const float mu : {0.2f, 0.8f}) {
    World world;
    const float slope = 0.5f;  // rad, tan = 0.546
    const Quat tilt(Eigen::AngleAxisf(-slope, Vec3::UnitZ()));
    world.addBody({.name = "slope",
                   .pose = {.position = tilt * Vec3(0, -1, 0), .orientation = tilt},
                   .motion_type = MotionType::Fixed,
                   .shapes = {Shape{Box{Vec3(50, 1, 5)}, {}}},
                   .friction = mu});
    ParticleDef def = oneParticle(tilt * Vec3(0, 0.02f, 0));
    def.settings.friction = mu;
    const ParticlesId id = world.addParticles(def);
    run(world, 1.0f);
    const double expected = std::max(0.0, kGravity * (std::sin(slope) - mu * std::cos(slope)));
    EXPECT_NEAR(world.particles(id).velocities()[0].norm(), expected, 0.01 * expected + 2e-3) << "mu " << mu;
  }
}

// 100 m/s is 20 cm in a sub-step; the plate is 2 cm thick.
TEST(Particles, NothingPassesThroughAThinPlate) {
  World world;
  world.addBody({.name = "plate", .motion_type = MotionType::Fixed, .shapes = {Shape{Box{Vec3(5, 0.01f, 5)}, {}}}});
  ParticleDef def{.name = "rain"};
  for (int i = 0; i < 100; ++i) {
    def.positions.push_back(Vec3(0.08f * static_cast<float>(i) - 4.0f, 1.0f + 0.013f * static_cast<float>(i), 0));
    def.velocities.push_back(Vec3(0, -100, 0));
    def.masses.push_back(0.01f);
  }
  const ParticlesId id = world.addParticles(def);
  run(world, 0.5f);
  for (const Vec3& p : world.particles(id).positions()) EXPECT_GT(p.y(), 0.0f);
}

TEST(Particles, ResultsDoNotDependOnTheNumberOfWorkers) {
  uint64_t hash[3] = {};
  for (const int workers : {1, 2, 3}) {
    WorldDef world_def;
    world_def.workers = workers;
    World world(world_def);
    addGround(world);
    world.addBody(
        {.name = "ball", .pose = {.position = Vec3(0.1f, 0.5f, 0.1f)}, .shapes = {Shape{Sphere{0.5f}, {}}}});
    ParticleDef def{.name = "sheet"};
    addCloth(def, {.corner = Vec3(-1, 1.3f, -1), .along = Vec3(2, 0, 0), .across = Vec3(0, 0, 2), .columns = 24, .rows = 20, .bending_stiffness = 1e-4f});
    world.addParticles(def);
    run(world, 0.7f);
    hash[workers - 1] = world.stateHash();
  }
  EXPECT_EQ(hash[0], hash[1]);
  EXPECT_EQ(hash[0], hash[2]);
}

// A rod of links and angular springs of stiffness EI / l, for deflections that are small: the moment at each spring is
// that of the weights beyond it, and its turn moves the tip by its distance. Tends to w L^4 / (8 EI) with many links.
TEST(Particles, ARodBendsAsTheTheoryOfBeamsSays) {
  World world;
  constexpr float kLength = 0.5f, kMass = 0.01f, kStiffness = 0.03f;
  constexpr int kCount = 9;
  ParticleDef def{.name = "rod", .settings = {.substeps = 16, .iterations = 8, .damping = 2.0f}};
  addRope(def, {.to = Vec3(kLength, 0, 0), .particles = kCount, .mass = kMass, .bending_stiffness = kStiffness});
  def.masses[0] = def.masses[1] = 0.0f;  // clamped: the direction at the wall lies half-way between the first links
  const ParticlesId id = world.addParticles(def);
  run(world, 6.0f);
  const double l = kLength / (kCount - 1.0);
  double expected = 0.0;
  for (int k = 1; k < kCount - 1; ++k) {
    double moment = 0.0;
    for (int j = k + 1; j < kCount; ++j) moment += kMass / kCount * kGravity * (j - k) * l;
    expected += moment * l / kStiffness * (kCount - 1 - k) * l;
  }
  const double tip = -world.particles(id).positions()[kCount - 1].y();
  EXPECT_NEAR(tip, expected, 0.03 * expected);  // deflected by a tenth of the length
}

TEST(Particles, WhatTheSystemSaysOfItselfContinuesToTheBit) {
  World world, copy;
  for (World* w : {&world, &copy}) addGround(*w);
  ParticleDef def{.name = "mixed"};
  addCloth(def, {.corner = Vec3(0, 1, 0), .columns = 12, .rows = 9, .bending_stiffness = 1e-3f});
  addSoftBox(def, {.center = Vec3(0.5f, 2, 0.5f), .half_extent = Vec3::Constant(0.3f), .cells = {2, 3, 2}});
  const ParticlesId id = world.addParticles(def);
  run(world, 1.0f);
  const ParticlesId other = copy.addParticles(world.particles(id).def());
  run(world, 1.0f);
  run(copy, 1.0f);
  EXPECT_EQ(world.particles(id).stateHash(), copy.particles(other).stateHash());
}

// The stage of particles must not be entered by a world that has none.
TEST(Particles, AWorldWithoutParticlesRunsNoStageForThem) {
  World world;
  addGround(world);
  run(world, kDt);
  const auto runs = [&] {
    const auto times = world.stageTimes();
    return std::any_of(times.begin(), times.end(), [](const StageTime& t) { return std::string_view(t.name) == "particles"; });
  };
  EXPECT_FALSE(runs());
  const ParticlesId id = world.addParticles(oneParticle(Vec3(0, 1, 0)));
  run(world, kDt);
  EXPECT_TRUE(runs());
  world.removeParticles(id);
  EXPECT_FALSE(world.isValid(id));
  run(world, kDt);
  EXPECT_FALSE(runs());
}

TEST(Particles, WhenABodyIsRemovedWhatHungOnItFalls) {
  World world;
  const BodyId post = world.addBody(
      {.name = "post", .motion_type = MotionType::Fixed, .shapes = {Shape{Box{Vec3::Constant(0.1f)}, {}}}});
  ParticleDef def{.name = "rope"};
  addRope(def, {.from = Vec3(0, -0.1f, 0), .to = Vec3(0, -1, 0)});
  def.anchors = {{.particle = 0, .body = post.index, .local = Vec3(0, -0.1f, 0)}};
  const ParticlesId id = world.addParticles(def);
  run(world, 0.5f);
  EXPECT_EQ(world.particles(id).positions()[0], Vec3(0, -0.1f, 0));
  world.removeBody(post);
  run(world, 0.5f);
  EXPECT_LT(world.particles(id).positions()[0].y(), -1.0f);
}

// Each kind of damage to a sound definition.
TEST(Particles, DefinitionsThatMakeNoSenseAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ParticleDef sound{.name = "sound"};
  addCloth(sound, {.columns = 4, .rows = 4, .bending_stiffness = 1.0f});
  addSoftBox(sound, {.cells = {1, 1, 1}});
  using Damage = void (*)(ParticleDef&, float);
  const Damage damages[] = {
      [](ParticleDef& d, float) { d = {}; },
      [](ParticleDef& d, float n) { d.positions[3].y() = n; },
      [](ParticleDef& d, float n) { d.masses[2] = n; },
      [](ParticleDef& d, float) { d.masses[2] = -1.0f; },
      [](ParticleDef& d, float) { d.masses.pop_back(); },
      [](ParticleDef& d, float) { d.velocities.push_back(Vec3::Zero()); },
      [](ParticleDef& d, float) { d.strands[0].particles[1] = 999; },
      [](ParticleDef& d, float) { d.strands[0].particles[1] = d.strands[0].particles[0]; },
      [](ParticleDef& d, float) { d.strands[0].particles.resize(1); },
      [](ParticleDef& d, float) { d.strands[0].lengths = {1.0f}; },
      [](ParticleDef& d, float n) { d.strands[0].compliance = n; },
      [](ParticleDef& d, float) { d.positions[1] = d.positions[0]; },
      [](ParticleDef& d, float) { d.distances[0].a = d.distances[0].b; },
      [](ParticleDef& d, float) { d.distances[0].length = 0.0f; },
      [](ParticleDef& d, float) { d.angles[0].chord = 3.0f; },
      [](ParticleDef& d, float) { d.angles[0].compliance = -1.0f; },
      [](ParticleDef& d, float n) { d.volumes[0].volume = n; },
      [](ParticleDef& d, float) { d.anchors = {{.particle = 0, .body = 5}}; },
      [](ParticleDef& d, float) { d.anchors = {{.particle = 99999, .body = 0}}; },
      [](ParticleDef& d, float) { d.settings.substeps = 0; },
      [](ParticleDef& d, float) { d.settings.iterations = 0; },
      [](ParticleDef& d, float n) { d.settings.radius = n; },
      [](ParticleDef& d, float) { d.settings.friction = -0.1f; },
      [](ParticleDef& d, float) { d.settings.warm_start = 1.5f; }};
  World world;
  addGround(world);
  EXPECT_NO_THROW(world.addParticles(sound));
  for (size_t i = 0; i < std::size(damages); ++i) {
    ParticleDef damaged = sound;
    damages[i](damaged, nan);
    EXPECT_THROW(world.addParticles(damaged), std::invalid_argument) << "damage " << i;
  }
  EXPECT_EQ(world.numParticleSystems(), 1u);
}

// Pins farther apart than the thread is long cannot be met; the thread must stay finite and between them.
TEST(Particles, AThreadThatCannotReachBothPinsStaysFinite) {
  World world;
  ParticleDef def{.name = "thread"};
  addRope(def, {.to = Vec3(1, 0, 0), .particles = 20});
  for (float& length : def.strands[0].lengths) length *= 0.8f;
  def.strands[0].lengths.assign(19, 0.8f / 19.0f);
  def.masses.front() = def.masses.back() = 0.0f;
  const ParticlesId id = world.addParticles(def);
  run(world, 5.0f);
  for (const Vec3& p : world.particles(id).positions()) EXPECT_LT((p - Vec3(0.5f, 0, 0)).norm(), 1.0f);
}

}  // namespace
