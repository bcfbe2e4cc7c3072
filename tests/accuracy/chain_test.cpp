// ACC-08, ACC-09 and ACC-04: heavy chain, catenary, heavy top, at 60 Hz and 4 sub-steps.
#include <gtest/gtest.h>

#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

struct ChainResult {
  Worst tip;       // m, of the first second
  double gap = 0;  // m
  Worst energy;    // relative to the drop's potential energy
};

// Ten links along +x and a ball welded to the last one, released at rest.
ChainResult dropChain(const std::string& ratio, int substeps) {
  const auto table = reference("heavy_chain")["cases"][ratio];
  World world(worldDef(substeps));
  BodyId last = addPost(world);
  const Rod link{.length = 0.2f, .width = 0.04f, .mass = 0.1f};
  for (int i = 0; i < 10; ++i) {
    const BodyId next = addRod(world, link, Vec3(0.2f * static_cast<float>(i) + 0.1f, 0, 0), M_PI / 2);
    world.addJoint({.body_a = last,
                    .body_b = next,
                    .params = BallJointParams{.anchor_point = Vec3(0.2f * static_cast<float>(i), 0, 0)}});
    last = next;
  }
  const BodyId ball = world.addBody({.name = "ball",
                                     .pose = {.position = Vec3(2, 0, 0)},
                                     .shapes = {{Sphere{0.2f}}},
                                     .mass = static_cast<float>(table["end_mass"].get<double>()),
                                     .filter_self = 0});
  world.addJoint({.body_a = last, .body_b = ball, .params = FixedJointParams{.anchor_point = Vec3(2, 0, 0)}});

  ChainResult out;
  const double scale = (1.0 + table["end_mass"].get<double>()) * kGravity * 2.0;
  for (int i = 1; i <= 120; ++i) {
    world.step(kDt);
    out.gap = std::max(out.gap, largestGap(world));
    out.energy.add(energy(world) / scale);
    if (i % 6 != 0 || i > 60) continue;
    const Vec3 p = world.states()[ball.index].position;
    const size_t row = static_cast<size_t>(i / 6);
    out.tip.add(
        std::hypot(p.x() - table["tip_x"][row].get<double>(), p.y() - table["tip_y"][row].get<double>()));
  }
  return out;
}

TEST(AccHeavyChain, holdsABallOfAnyMass) {
  for (const char* ratio : {"1:1", "1:10", "1:100", "1:1000"}) {
    const ChainResult r = dropChain(ratio, 4);
    std::printf("heavy chain %s\n", ratio);
    report("tip, first second", r.tip.value, 0.02, "m");
    report("gap", r.gap, 1e-3, "m");
    report("energy, share of what the fall gives", r.energy.value, 1e-2, "");
    EXPECT_LT(r.tip.value, 0.02) << ratio;
    EXPECT_LT(r.gap, 1e-3) << ratio;
  }
}

TEST(AccHeavyChain, errorFallsWithTheSquareOfTheSubstep) {
  const double coarse = dropChain("1:1000", 4).tip.value, fine = dropChain("1:1000", 64).tip.value;
  report("heavy chain plateau, error at 64 sub-steps", fine, coarse / 8, "m");
  EXPECT_LE(fine, coarse / 8);
}

TEST(AccCatenary, restsOnTheExactPolygon) {
  const auto table = reference("catenary")["cases"][0];
  const auto n = table["n"].get<size_t>();
  const double weight = table["link_mass"].get<double>() * kGravity,
               pull_expected = table["rods"]["H"].get<double>();
  std::vector<Vec3d> nodes = {Vec3d::Zero()};
  for (size_t i = 0; i < n; ++i) {
    const double slope = weight * (static_cast<double>(i) + 0.5 - static_cast<double>(n) / 2) / pull_expected;
    nodes.push_back(nodes.back() + 0.1 / std::hypot(1.0, slope) * Vec3d(1.0, slope, 0.0));
  }
  EXPECT_NEAR(nodes.back().x(), table["span"].get<double>(), 1e-10);  // the table's digits
  World world(worldDef(4));
  const BodyId post = addPost(world);
  BodyId last = post;
  std::vector<BodyId> links;
  for (size_t i = 0; i < n; ++i) {
    const Vec3d d = nodes[i + 1] - nodes[i];
    const BodyId next = addRod(world, {.length = 0.1f, .width = 0.02f, .mass = 0.05f},
                               (0.5 * (nodes[i] + nodes[i + 1])).cast<float>(), std::atan2(d.x(), -d.y()));
    world.addJoint(
        {.body_a = last, .body_b = next, .params = BallJointParams{.anchor_point = nodes[i].cast<float>()}});
    links.push_back(next);
    last = next;
  }
  world.addJoint(
      {.body_a = last, .body_b = post, .params = BallJointParams{.anchor_point = nodes[n].cast<float>()}});
  double gap = 0.0, shift = 0.0, speed = 0.0;
  for (int i = 0; i < 300; ++i) {
    world.step(kDt);
    gap = std::max(gap, largestGap(world));
  }
  for (size_t i = 0; i < n; ++i) {
    const RigidState& s = world.states()[links[i].index];
    shift = std::max(shift, (s.position.cast<double>() - 0.5 * (nodes[i] + nodes[i + 1])).norm());
    speed = std::max(speed, static_cast<double>(s.linear_velocity.norm()));
  }
  const double pull = std::abs(world.joints()[50].force.x()) / pull_expected - 1.0;
  std::printf("catenary of 100 links, 5 s\n");
  report("deviation", shift, 1e-3, "m");
  report("gap", gap, 1e-5, "m");
  report("residual speed", speed, 1e-3, "m/s");
  report("horizontal force, relative", pull, 1e-3, "");
  EXPECT_LT(shift, 1e-3);
  EXPECT_LT(gap, 1e-5);
  // Poses are rounded to floats once a step, 2.4e-7 m at 8 m from the origin; holding the joints makes 6e-5
  // m/s of that, which nothing damps.
  EXPECT_LT(speed, 1e-3);
  EXPECT_LT(std::abs(pull), 1e-3);
}

struct TopResult {
  double axis = 0.0;  // rad
  double gap = 0.0;   // m
};

// Cylinder of radius 0.25 m and 2 kg, its centre 0.5 m from a ball joint at the origin; y is its axis of
// symmetry.
TopResult spinTop(const std::string& name, int substeps) {
  const auto table = reference("heavy_top")["cases"][name];
  const double theta = table["theta0_deg"].get<double>() * M_PI / 180.0;
  const Vec3d axis(0.0, std::cos(theta), std::sin(theta));
  const Quatd turn(std::cos(theta / 2), std::sin(theta / 2), 0.0, 0.0);  // about x: y goes to the axis
  const double i3 = 0.5 * 2.0 * 0.0625;
  World world(worldDef(substeps));
  const BodyId post = addPost(world);
  Mat3 inertia = Vec3(static_cast<float>(reference("heavy_top")["I1_pivot"].get<double>() - 0.5),
                      static_cast<float>(i3), 0.0f)
                     .asDiagonal();
  inertia(2, 2) = inertia(0, 0);
  const BodyId top =
      world.addBody({.name = "top",
                     .pose = {.position = (0.5 * axis).cast<float>(), .orientation = turn.cast<float>()},
                     .shapes = {{Sphere{0.25f}}},
                     .mass = 2.0f,
                     .inertia = inertia,
                     .filter_self = 0});
  world.addJoint({.body_a = post, .body_b = top, .params = BallJointParams{}});
  const Vec3d w = table["precession0"].get<double>() * (Vec3d::UnitY() - axis * axis.y()) +
                  table["spin_w3"].get<double>() * axis;
  world.state(top).angular_velocity = w.cast<float>();
  world.state(top).linear_velocity = w.cross(0.5 * axis).cast<float>();

  TopResult out;
  const double interval = table["t"][1].get<double>();
  const int frames = static_cast<int>(std::lround(interval * 60.0));
  for (size_t row = 1; row < table["t"].size(); ++row) {
    for (int i = 0; i < frames; ++i) {
      world.step(kDt);
      out.gap = std::max(out.gap, largestGap(world));
    }
    const Vec3d now = world.states()[top.index].orientation.cast<double>() * Vec3d::UnitY();
    const auto& r = table["axis_world"][row];
    const Vec3d expected(r[0].get<double>(), r[1].get<double>(), r[2].get<double>());
    out.axis = std::max(out.axis, std::atan2(now.cross(expected).norm(), now.dot(expected)));
  }
  return out;
}

TEST(AccHeavyTop, precessesAndNutatesLikeTheTable) {
  for (const char* name : {"steady_slow", "cusp_release", "slow_spin_swing", "no_spin_spherical"}) {
    const TopResult r = spinTop(name, 4);
    std::printf("heavy top, %s\n", name);
    report("axis", r.axis, 0.05, "rad");
    report("gap", r.gap, 1e-4, "m");
    EXPECT_LT(r.axis, 0.05) << name;
    EXPECT_LT(r.gap, 1e-4) << name;
  }
}

TEST(AccHeavyTop, errorFallsWithTheSquareOfTheSubstep) {
  const double coarse = spinTop("cusp_release", 4).axis, fine = spinTop("cusp_release", 64).axis;
  report("heavy top plateau, error at 64 sub-steps", fine, coarse / 8, "rad");
  EXPECT_LE(fine, coarse / 8);
}

}  // namespace
}  // namespace pfx_test
