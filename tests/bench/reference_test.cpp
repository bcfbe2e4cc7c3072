// The answers of the accuracy cases against tables that were made by other methods (tests/accuracy/ref).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "samples/accuracy/case.h"
#include "samples/accuracy/planar_chain.h"

namespace {

using pfx::Quatd;
using pfx::Vec3d;
using samples::accuracy::Run;

constexpr double kFrame = 1.0 / 60.0;

nlohmann::json table(const std::string& name) {
  std::ifstream file(std::string(VITRINE_SOURCE_DIR) + "/tests/accuracy/ref/" + name + ".json");
  return nlohmann::json::parse(file);
}

std::unique_ptr<Run> start(const char* name) {
  const auto* found = samples::accuracy::findCase(name);
  EXPECT_NE(found, nullptr) << name;
  return found->make();
}

void advanceTo(Run& run, double& now, double seconds) {
  while (now + 0.5 * kFrame < seconds) run.advance(kFrame), now += kFrame;
}

double angleAboutZ(const Quatd& q) { return std::remainder(2.0 * std::atan2(q.z(), q.w()), 2.0 * M_PI); }

TEST(AccuracyCase, aDoublePendulumFollowsTheTable) {
  const auto ref = table("double_pendulum");
  const auto run = start("double_pendulum");
  double now = 0.0;
  for (size_t row = 1; row <= 20; ++row) {
    advanceTo(*run, now, ref["t"][row].get<double>());
    const auto truth = run->truth();
    // Gravity is rounded to a float, as in the world: 4.3e-8 more than the table's, which errors of this motion grow by
    // up to 26 (the table's amplification).
    EXPECT_NEAR(std::remainder(angleAboutZ(truth[0].pose.orientation) - ref["theta1"][row].get<double>(), 2 * M_PI), 0, 1e-6);
    EXPECT_NEAR(std::remainder(angleAboutZ(truth[1].pose.orientation) - ref["theta2"][row].get<double>(), 2 * M_PI), 0, 1e-6);
  }
}

TEST(AccuracyCase, heavyChainsFollowTheTable) {
  for (const auto& [name, ratio] : {std::pair("chain", "1:1"), std::pair("heavy_chain", "1:1000")}) {
    const auto ref = table("heavy_chain")["cases"][ratio];
    const auto run = start(name);
    double now = 0.0;
    for (size_t row = 1; row <= 10; ++row) {
      advanceTo(*run, now, ref["t"][row].get<double>());
      const Vec3d tip = run->truth().back().pose.position;
      // A hundredth of what a float position of this size can hold.
      EXPECT_NEAR(tip.x(), ref["tip_x"][row].get<double>(), 1e-6) << ratio << " row " << row;
      EXPECT_NEAR(tip.y(), ref["tip_y"][row].get<double>(), 1e-6) << ratio << " row " << row;
    }
  }
}

TEST(AccuracyCase, aSpinningTopFollowsTheTable) {
  const auto ref = table("heavy_top")["cases"]["cusp_release"];
  const auto run = start("heavy_top");
  double now = 0.0;
  for (size_t row = 1; row < ref["t"].size(); ++row) {
    advanceTo(*run, now, ref["t"][row].get<double>());
    const auto& axis = ref["axis_world"][row];
    const Vec3d expected(axis[0].get<double>(), axis[1].get<double>(), axis[2].get<double>());
    const Vec3d found = run->truth()[0].pose.orientation * Vec3d::UnitX();
    EXPECT_LT((found - expected).norm(), 1e-5) << row;  // far below the 1e-3 rad that the case can tell apart
  }
}

TEST(AccuracyCase, aFreeTopKeepsItsEnergyAndTurnsOverOnTime) {
  // Flip of the middle axis: 4.5526935305 s after the start (elliptic functions); its axis then points the other way.
  const auto run = start("flipping_top");
  double now = 0.0;
  advanceTo(*run, now, 2 * 4.5526935305);
  const Vec3d axis = run->truth()[0].pose.orientation * Vec3d::UnitY();
  const auto again = start("flipping_top");
  const Vec3d begin = again->truth()[0].pose.orientation * Vec3d::UnitY();
  EXPECT_GT(axis.dot(begin), 0.99);  // after two flips it is where it began
}

TEST(AccuracyCase, aPuckStopsWhereFarkasSaysAndAMasseShotRunsAlongItsParabola) {
  const auto puck = start("puck");
  double now = 0.0;
  advanceTo(*puck, now, 1.5);
  // The last frame of motion is left out, in which it goes 1e-4 m; the quadrature is good to 1e-4.
  EXPECT_NEAR(puck->truth()[0].pose.position.x(), 1.0880617, 5e-4);

  const auto shot = start("masse_shot");
  double time = 0.0;
  advanceTo(*shot, time, 2.0);
  EXPECT_NEAR(shot->truth()[0].pose.position.x(), 1.49644743414625, 1e-6);
  EXPECT_NEAR(shot->truth()[0].pose.position.z(), 1.49928948682925, 1e-6);
}

TEST(AccuracyCase, everyCaseStartsWithoutError) {
  for (const auto& c : samples::accuracy::cases()) {
    pfx::World world(worldDef(c));
    const auto run = c.make();
    run->build(world);
    EXPECT_LE(std::abs(run->error(samples::bodyMotions(world))), 1e-5) << c.name;  // places are rounded to floats
  }
}

}  // namespace
