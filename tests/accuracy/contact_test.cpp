// ACC-11 to ACC-16: friction and impact against closed forms, at 60 Hz and 4 sub-steps.
#include <gtest/gtest.h>

#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

struct Surface {
  float friction = 0.0f, restitution = 0.0f;
};

BodyId addGround(World& world, const Surface& s, float scale = 1.0f) {
  return world.addBody({.pose = {.position = Vec3(0, -scale, 0)},
                        .motion_type = MotionType::Fixed,
                        .shapes = {{Box{scale * Vec3(400, 1, 400)}}},
                        .restitution = s.restitution,
                        .friction = s.friction});
}

BodyId addShape(World& world, const Geometry& geometry, const Vec3& at, const Surface& s) {
  return world.addBody({.pose = {.position = at},
                        .shapes = {{geometry}},
                        .mass = 1.0f,
                        .restitution = s.restitution,
                        .friction = s.friction});
}

void run(World& world, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 60.0 + 0.5); ++i) world.step(kDt);
}

// ACC-11: a box comes to rest after v^2 / (2 mu g).
TEST(AccFriction, aBoxSlidesTheRightDistance) {
  Worst error, aside;
  for (const float mu : {0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const float speed : {1.0f, 5.0f, 20.0f}) {
      World world(worldDef(4));
      addGround(world, {mu});
      const BodyId box = addShape(world, Box{Vec3(0.5f, 0.25f, 0.5f)}, Vec3(0, 0.25f, 0), {mu});
      world.state(box).linear_velocity = Vec3(speed, 0, 0);
      const double time = speed / (mu * kGravity);
      run(world, time + 1.0);
      const Vec3 p = world.states()[box.index].position;
      const double expected = 0.5 * speed * time;
      error.add(p.x() / expected - 1.0);
      aside.add(p.z());
      std::printf("    mu %.1f, v %4.1f m/s: distance %+.2e\n", mu, speed, p.x() / expected - 1.0);
    }
  }
  report("ACC-11 sliding distance, relative", error.value, 1e-3, "");
  report("ACC-11 sliding box, drift to the side", aside.value, 1e-3, "m");
  EXPECT_LT(std::abs(aside.value), 1e-3);
  EXPECT_LT(std::abs(error.value), 1e-3);
}

struct Incline {
  World world;
  BodyId box;
  Vec3 down;  // unit, along the slope
};

// A slope is a flat floor with tilted gravity.
Incline makeIncline(double mu, double degrees) {
  const double angle = degrees * M_PI / 180.0;
  WorldDef def = worldDef(4);
  def.gravity = static_cast<float>(kGravity) *
                Vec3(static_cast<float>(std::sin(angle)), -static_cast<float>(std::cos(angle)), 0);
  Incline i{World(def), {}, Vec3::UnitX()};
  addGround(i.world, {static_cast<float>(mu)});
  i.box = addShape(i.world, Box{Vec3(0.5f, 0.25f, 0.5f)}, Vec3(0, 0.25f, 0), {static_cast<float>(mu)});
  return i;
}

// ACC-12
TEST(AccFriction, aBoxOnASlopeSticksBelowTheAngleOfFrictionAndSlidesAbove) {
  Worst creep, distance;
  for (const double mu : {0.2, 0.5, 0.8}) {
    const double critical = std::atan(mu) * 180.0 / M_PI;
    for (const double below : {1.0, 0.1}) {
      Incline i = makeIncline(mu, critical - below);
      run(i.world, 2.0);
      creep.add(i.world.states()[i.box.index].position.dot(i.down));
    }
    for (const double above : {1.0, 5.0}) {
      Incline i = makeIncline(mu, critical + above);
      run(i.world, 2.0);
      const double angle = (critical + above) * M_PI / 180.0;
      const double expected = 2.0 * kGravity * (std::sin(angle) - mu * std::cos(angle));
      distance.add(i.world.states()[i.box.index].position.dot(i.down) / expected - 1.0);
    }
  }
  report("ACC-12 slope, creep in 2 s", creep.value, 1e-5, "m");
  report("ACC-12 slope, distance slid, relative", distance.value, 5e-3, "");
  EXPECT_LT(std::abs(creep.value), 1e-5);
  EXPECT_LT(std::abs(distance.value), 5e-3);
}

// ACC-12: the angle at which a box begins to slide, within 2 s, by bisection.
TEST(AccFriction, aBoxBeginsToSlideAtTheAngleOfFriction) {
  Worst error;
  for (const double mu : {0.2, 0.5, 0.8}) {
    const double critical = std::atan(mu) * 180.0 / M_PI;
    double low = critical - 0.2, high = critical + 0.2;
    for (int i = 0; i < 6; ++i) {
      const double middle = 0.5 * (low + high);
      Incline incline = makeIncline(mu, middle);
      run(incline.world, 2.0);
      // 0.01 degrees above the angle it is 4 mm
      (incline.world.states()[incline.box.index].position.dot(incline.down) > 1e-3f ? high : low) = middle;
    }
    error.add(0.5 * (low + high) - critical);
  }
  report("ACC-12 slope, critical angle", error.value, 2e-2, "deg");
  EXPECT_LT(std::abs(error.value), 2e-2);
}

TEST(AccFriction, aBoxOnASlopeDoesNotCreep) {
  Incline i = makeIncline(0.6, 10.0);
  run(i.world, 10.0);
  const Vec3 early = i.world.states()[i.box.index].position;
  run(i.world, 60.0);
  const double creep = 1e3 * (i.world.states()[i.box.index].position - early).dot(i.down);
  report("slope of 10 degrees, creep a minute", creep, 0.1, "mm");
  EXPECT_LT(std::abs(creep), 0.1);
}

// ACC-13
TEST(AccFriction, aBallThatSlidesBeginsToRoll) {
  World world(worldDef(4));
  addGround(world, {0.2f});
  const BodyId ball = addShape(world, Sphere{0.5f}, Vec3(0, 0.5f, 0), {0.2f});
  world.state(ball).linear_velocity = Vec3(4, 0, 0);
  run(world, 2.0);
  const RigidState& s = world.states()[ball.index];
  const double speed = s.linear_velocity.x() / (20.0 / 7.0) - 1.0, way = s.position.x() / 6.0471405688 - 1.0;
  const double slip = s.linear_velocity.x() + 0.5 * s.angular_velocity.z();
  report("ACC-13 slip to roll, speed, relative", speed, 1e-4, "");
  report("ACC-13 slip to roll, way in 2 s, relative", way, 1e-4, "");
  report("ACC-13 slip to roll, slip left", slip, 1e-4, "m/s");
  EXPECT_LT(std::abs(speed), 1e-4);
  EXPECT_LT(std::abs(slip), 1e-4);
  EXPECT_LT(std::abs(way), 1e-4);
}

// ACC-14: a ball with side spin runs a parabola, whichever way the axes lie.
TEST(AccFriction, aMasseShotIsTheSameInEveryDirection) {
  Worst error, across;
  Vec3 first = Vec3::Zero();
  for (int k = 0; k <= 12; ++k) {
    const Quat turn(Eigen::AngleAxisf(7.5f * static_cast<float>(k * M_PI / 180.0), Vec3::UnitY()));
    World world(worldDef(4));
    addGround(world, {0.3f});
    const BodyId ball = addShape(world, Sphere{0.1f}, Vec3(0, 0.1f, 0), {0.3f});
    world.state(ball).linear_velocity = turn * Vec3(2, 0, 1);
    world.state(ball).angular_velocity = turn * Vec3(0, 5, 30);
    run(world, 2.0);
    const Vec3 p = turn.conjugate() * world.states()[ball.index].position;
    if (k == 0) first = p;
    error.add((p - Vec3(1.4964474341f, 0.1f, 1.4992894868f)).norm());
    across.add((p - first).norm());
  }
  report("ACC-14 masse shot, position after 2 s", error.value, 2e-3, "m");
  report("ACC-14 masse shot, spread over directions", across.value, 1e-4, "m");
  EXPECT_LT(across.value, 1e-4);
  EXPECT_LT(error.value, 2e-3);
}

// ACC-15: a disc that slides and spins stops doing both at once (Farkas 2003, uniform pressure).
TEST(AccFriction, aPuckStopsSlidingAndSpinningTogether) {
  World world(worldDef(4));
  addGround(world, {0.3f});
  const BodyId puck = world.addBody({.pose = {.position = Vec3(0, 0.005f, 0)},
                                     .shapes = {{Cylinder{0.005f, 0.1f}, {.orientation = aboutZ(M_PI / 2)}}},
                                     .restitution = 0.0f,
                                     .friction = 0.3f});
  world.state(puck).linear_velocity = Vec3(2, 0, 0);
  world.state(puck).angular_velocity = Vec3(0, 30, 0);
  double angle = 0.0;
  for (int i = 0; i < 120; ++i) {
    world.step(kDt);
    angle += world.states()[puck.index].angular_velocity.y() * static_cast<double>(kDt);
  }
  const double way = world.states()[puck.index].position.x() / 1.0880617 - 1.0,
               turned = angle / 16.403482 - 1.0;
  report("ACC-15 puck, distance, relative", way, 0.05, "");
  report("ACC-15 puck, angle, relative", turned, 0.05, "");
  EXPECT_LT(std::abs(way), 0.05);
  EXPECT_LT(std::abs(turned), 0.05);
}

// Heights of the first bounces of a ball dropped from `height` above the floor, in units of it.
std::vector<double> bounces(float restitution, float height, double seconds, float scale = 1.0f) {
  WorldDef def = worldDef(4);
  World world(def);
  addGround(world, {0.0f, restitution}, scale);
  const float radius = 0.25f * scale;
  const BodyId ball =
      addShape(world, Sphere{radius}, Vec3(0, radius + height * scale, 0), {0.0f, restitution});
  std::vector<double> heights;
  const auto dt = static_cast<float>(kDt * std::sqrt(scale));
  double best = 0.0;
  bool rising = false;
  for (int i = 0; i < static_cast<int>(seconds * 60.0); ++i) {
    world.step(dt);
    const RigidState& s = world.states()[ball.index];
    const double v = s.linear_velocity.y(), y = (s.position.y() - radius) / (height * scale);
    // the top of the parabola that the ball is on
    if (v > 0.0) best = y + 0.5 * v * v / kGravity / (height * scale), rising = true;
    if (v < 0.0 && rising) heights.push_back(best), rising = false;
  }
  return heights;
}

// ACC-16
TEST(AccImpact, aBallBouncesToTheRightHeight) {
  Worst first, third;
  for (const float height : {1.0f, 5.0f}) {
    for (const float e : {1.0f, 0.9f, 0.8f, 0.5f}) {
      const std::vector<double> h = bounces(e, height, 12.0);
      ASSERT_GE(h.size(), 3u);
      first.add(h[0] / std::pow(e, 2) - 1.0);
      third.add(h[2] / std::pow(e, 6) - 1.0);
      std::printf("    h %.0f m, e %.1f: heights %+.2e %+.2e\n", height, e, h[0] / std::pow(e, 2) - 1.0,
                  h[2] / std::pow(e, 6) - 1.0);
    }
  }
  report("ACC-16 height after the 1st bounce, relative", first.value, 5e-3, "");
  report("ACC-16 height after the 3rd bounce, relative", third.value, 5e-3, "");
  EXPECT_LT(std::abs(first.value), 5e-3);
  EXPECT_LT(std::abs(third.value), 5e-3);
}

TEST(AccImpact, aBallThatLosesNothingGainsNothingInAHundredBounces) {
  const std::vector<double> h = bounces(1.0f, 1.0f, 92.0);
  ASSERT_GE(h.size(), 100u);
  report("ACC-16 e = 1: height after 100 bounces, change", h[99] - 1.0, 1e-2, "");
  EXPECT_LT(h[99], 1.001);
  EXPECT_GT(h[99], 0.0);
}

// ACC-17: a rod that falls on a floor without friction gets J = m (1 + e) v / (1 + m r^2 / I), with the lever r of the edge
// that hits; one that falls flat does not turn.
TEST(AccImpact, aRodLeavesTheFloorAsItsEdgeHitIt) {
  constexpr double kSpeed = 3.0, kLong = 0.5, kThick = 0.05;  // m/s, m, half extents
  Worst speed, spin;
  for (const float e : {0.5f, 1.0f}) {
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0}) {
      WorldDef def = worldDef(4);
      def.gravity = Vec3::Zero();
      World world(def);
      addGround(world, {0.0f, e});
      const double angle = degrees * M_PI / 180.0, s = std::sin(angle), c = std::cos(angle);
      const double height = kLong * s + kThick * c;
      const BodyId rod = world.addBody({.pose = {.position = Vec3(0, static_cast<float>(height) + 0.13f, 0), .orientation = aboutZ(angle)},
                                        .linear_velocity = Vec3(0, static_cast<float>(-kSpeed), 0),
                                        .shapes = {{Box{Vec3(static_cast<float>(kLong), static_cast<float>(kThick), 0.05f)}}},
                                        .restitution = e,
                                        .friction = 0.0f});
      run(world, 0.09);
      const double lever = degrees > 0.0 ? kLong * c - kThick * s : 0.0;  // the lowest edge is on the left
      const double inertia = (kLong * kLong + kThick * kThick) / 3.0;
      const double impulse = (1.0 + static_cast<double>(e)) * kSpeed / (1.0 + lever * lever / inertia);
      const RigidState& state = world.states()[rod.index];
      speed.add((state.linear_velocity.y() - (impulse - kSpeed)) / kSpeed);
      spin.add((state.angular_velocity.z() + impulse * lever / inertia) / (kSpeed / kLong));
    }
  }
  report("ACC-17 rod, speed after the impact, of that before", speed.value, 1e-2, "");
  report("ACC-17 rod, spin after the impact, of v / l", spin.value, 1e-2, "");
  EXPECT_LT(std::abs(speed.value), 1e-2);
  EXPECT_LT(std::abs(spin.value), 1e-2);
}

// ACC-17: five balls with gaps of 1 mm; the last one flies off alone.
TEST(AccImpact, aCradlePassesTheBlowOn) {
  WorldDef def = worldDef(4);
  def.gravity = Vec3::Zero();
  World world(def);
  for (int i = 0; i < 5; ++i)
    addShape(world, Sphere{0.05f}, Vec3(0.101f * static_cast<float>(i), 0, 0), {0.0f, 1.0f});
  world.state(world.bodyId(0)).linear_velocity = Vec3(1, 0, 0);
  run(world, 1.0);
  Worst error;
  double momentum = 0.0, twice_energy = 0.0;
  for (int i = 0; i < 5; ++i) {
    const double v = world.states()[static_cast<size_t>(i)].linear_velocity.x();
    error.add(v - (i == 4));
    momentum += v, twice_energy += v * v;
    std::printf("    ball %d: %+.4f m/s\n", i, v);
  }
  report("ACC-17 cradle, velocity of a ball", error.value, 1e-2, "m/s");
  report("ACC-17 cradle, momentum, relative", momentum - 1.0, 1e-6, "");
  report("ACC-17 cradle, energy, relative", twice_energy - 1.0, 1e-2, "");
  EXPECT_LT(std::abs(error.value), 1e-2);
  EXPECT_LT(std::abs(momentum - 1.0), 1e-5);
  EXPECT_LT(twice_energy, 1.001);
}

}  // namespace
}  // namespace pfx_test
