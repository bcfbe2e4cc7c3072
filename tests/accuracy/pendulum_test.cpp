// ACC-05 to ACC-07: pendulums against elliptic functions and tables, at 60 Hz and 4 sub-steps.
#include <gtest/gtest.h>

#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

struct Pendulum {
  World world;
  BodyId rod;
};

Pendulum makePendulum(double angle, int substeps) {
  Pendulum p{World(worldDef(substeps)), {}};
  const BodyId post = addPost(p.world);
  p.rod = addRod(p.world, {}, downAt(angle, 0.5), angle);
  p.world.addJoint({.body_a = post, .body_b = p.rod, .params = HingeJointParams{.axis = Vec3::UnitZ()}});
  return p;
}

constexpr double kPivotInertia = 1.0 / 3.0 + 0.01 / 12.0;  // kg m^2, of the rod about its end

// theta'' = -(m g d / I) sin theta by Runge-Kutta with 64 steps a frame, which is exact to 1e-10 here.
struct PendulumReference {
  double theta, omega = 0.0;
  void advance(double dt) {
    const double w2 = kGravity * 0.5 / kPivotInertia;
    const auto slope = [&](double t, double w) { return std::pair(w, -w2 * std::sin(t)); };
    const double h = dt / 64;
    for (int i = 0; i < 64; ++i) {
      const auto [a1, b1] = slope(theta, omega);
      const auto [a2, b2] = slope(theta + h / 2 * a1, omega + h / 2 * b1);
      const auto [a3, b3] = slope(theta + h / 2 * a2, omega + h / 2 * b2);
      const auto [a4, b4] = slope(theta + h * a3, omega + h * b3);
      theta += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      omega += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
  }
};

TEST(AccPendulum, theReferenceAgreesWithTheTable) {
  for (const auto& c : reference("pendulum")["cases"]) {
    PendulumReference r{c["theta0_deg"].get<double>() * M_PI / 180.0};
    double t = 0.0;
    for (size_t i = 0; i < c["t"].size(); ++i) {
      const double dt = c["t"][i].get<double>() - t;
      for (int k = 0; k < 64; ++k) r.advance(dt / 64);
      t += dt;
      // The table is exact to 1e-14; a release from 179 degrees amplifies the rounding of its start a
      // hundredfold.
      EXPECT_NEAR(r.theta, c["theta"][i].get<double>(), 1e-10) << c["theta0_deg"];
    }
  }
}

struct PendulumResult {
  Worst angle;   // rad
  Worst energy;  // relative to m g l
  double gap;    // m
};

PendulumResult swing(double degrees, int substeps, double seconds) {
  const double start = degrees * M_PI / 180.0;
  Pendulum p = makePendulum(start, substeps);
  PendulumReference r{start};
  const double e0 = energy(p.world);
  PendulumResult out = {};
  for (int i = 0; i < static_cast<int>(std::lround(seconds / kDt)); ++i) {
    p.world.step(kDt);
    r.advance(kDt);
    out.angle.add(wrapped(angleAboutZ(p.world.states()[p.rod.index]) - r.theta));
    out.energy.add((energy(p.world) - e0) / kGravity);
    out.gap = std::max(out.gap, largestGap(p.world));
  }
  return out;
}

TEST(AccPendulum, followsTheEllipticFunctionForTenSeconds) {
  for (const double degrees : {5.0, 30.0, 90.0, 150.0, 179.0}) {
    const PendulumResult r = swing(degrees, 4, 10.0);
    std::printf("pendulum released at %g degrees, 10 s\n", degrees);
    report("angle", r.angle.value, 5e-3, "rad");
    report("energy / m g l", r.energy.value, 1e-3, "");
    report("gap", r.gap, 1e-5, "m");
    EXPECT_LT(std::abs(r.angle.value), 5e-3);
    EXPECT_LT(std::abs(r.energy.value), 1e-3);
    EXPECT_LT(r.gap, 1e-5);
  }
}

TEST(AccPendulum, errorFallsWithTheSquareOfTheSubstep) {
  const double coarse = std::abs(swing(90.0, 4, 5.0).angle.value),
               fine = std::abs(swing(90.0, 64, 5.0).angle.value);
  report("pendulum plateau, error at 64 sub-steps", fine, coarse / 8, "rad");
  EXPECT_LE(fine, coarse / 8);
}

TEST(AccPendulum, reportsTheReactionAtTheBottom) {
  Pendulum p = makePendulum(M_PI / 2, 4);
  double best = 1e9, force = 0.0;
  for (int i = 0; i < 60; ++i) {
    // The force is the mean of the step, so it belongs to the middle of it.
    const double before = angleAboutZ(p.world.states()[p.rod.index]);
    p.world.step(kDt);
    const double middle = 0.5 * (before + angleAboutZ(p.world.states()[p.rod.index]));
    if (std::abs(middle) < best) best = std::abs(middle), force = p.world.joints()[0].force.norm();
  }
  const double expected = reference("pendulum")["cases"][2]["reaction_bottom_N"];
  report("reaction at the bottom, relative", force / expected - 1.0, 1e-2, "");
  EXPECT_NEAR(force / expected, 1.0, 1e-2);  // the nearest frame is up to half a frame from the bottom
}

struct DoublePendulum {
  World world;
  BodyId first, second;
};

DoublePendulum makeDoublePendulum(int substeps) {
  DoublePendulum p{World(worldDef(substeps)), {}, {}};
  const BodyId post = addPost(p.world);
  p.first = addRod(p.world, {}, Vec3(0.5f, 0, 0), M_PI / 2);
  p.second = addRod(p.world, {}, Vec3(1.5f, 0, 0), M_PI / 2);
  const Vec3 z = Vec3::UnitZ();
  p.world.addJoint({.body_a = post, .body_b = p.first, .params = HingeJointParams{.axis = z}});
  p.world.addJoint({.body_a = p.first,
                    .body_b = p.second,
                    .params = HingeJointParams{.anchor_point = Vec3(1, 0, 0), .axis = z}});
  return p;
}

// Largest error of the two angles at t = seconds, not divided by the growth factor.
double doublePendulumError(int substeps, int seconds) {
  const auto table = reference("double_pendulum");
  DoublePendulum p = makeDoublePendulum(substeps);
  for (int i = 0; i < 60 * seconds; ++i) p.world.step(kDt);
  const size_t row = static_cast<size_t>(10 * seconds);
  Worst error;
  error.add(wrapped(angleAboutZ(p.world.states()[p.first.index]) - table["theta1"][row].get<double>()));
  error.add(wrapped(angleAboutZ(p.world.states()[p.second.index]) - table["theta2"][row].get<double>()));
  return error.value;
}

TEST(AccDoublePendulum, followsTheTableUntilItTurnsChaotic) {
  const auto growth = reference("double_pendulum")["amplification"];
  for (const int seconds : {1, 2, 3, 5}) {
    const double error = doublePendulumError(4, seconds);
    const std::string what = "double pendulum, t = " + std::to_string(seconds) + " s";
    report(what.c_str(), error, 5e-3, "rad");
    const double scaled = error / growth[static_cast<size_t>(10 * seconds)].get<double>();
    report("  divided by the growth factor", scaled, 5e-3, "rad");
    EXPECT_LT(std::abs(scaled), 5e-3);
  }
}

TEST(AccDoublePendulum, errorFallsWithTheSquareOfTheSubstep) {
  const double coarse = std::abs(doublePendulumError(4, 2)), fine = std::abs(doublePendulumError(64, 2));
  report("double pendulum plateau, error at 64 sub-steps", fine, coarse / 8, "rad");
  EXPECT_LE(fine, coarse / 8);
}

// ACC-06: a rod on a ball joint that circles at a constant angle, w^2 = m g d / ((I1 - I3) cos theta), with
// no spin of the rod relative to the plane that turns with it.
TEST(AccConicalPendulum, keepsItsRadiusAndItsPeriod) {
  const double theta = M_PI / 6, length = 0.5, width = 0.05, mass = 1.0;
  const double i3 = mass * width * width / 6.0, i1 = mass * (length * length + width * width) / 12.0;
  const double pivot = i1 + mass * length * length / 4.0;
  const double rate = std::sqrt(mass * kGravity * 0.5 * length / ((pivot - i3) * std::cos(theta)));
  World world(worldDef(4));
  const BodyId post = addPost(world);
  const BodyId rod = addRod(world, {.length = 0.5f, .width = 0.05f}, downAt(theta, length / 2), theta);
  world.addJoint({.body_a = post, .body_b = rod, .params = BallJointParams{}});
  world.state(rod).angular_velocity = Vec3(0, static_cast<float>(rate), 0);
  world.state(rod).linear_velocity =
      world.states()[rod.index].angular_velocity.cross(world.states()[rod.index].position);
  Worst radius, phase;
  for (int i = 1; i <= 300; ++i) {
    world.step(kDt);
    const Vec3 p = world.states()[rod.index].position;
    radius.add(std::hypot(p.x(), p.z()) / (0.5 * length * std::sin(theta)) - 1.0);
    phase.add(wrapped(std::atan2(-p.z(), p.x()) - rate * i * static_cast<double>(kDt)));
  }
  report("conical pendulum, radius, relative", radius.value, 1e-3, "");
  report("conical pendulum, phase after 5 s", phase.value, 1e-2, "rad");
  EXPECT_LT(std::abs(radius.value), 1e-3);
  EXPECT_LT(std::abs(phase.value), 1e-2);
}

}  // namespace
}  // namespace pfx_test
