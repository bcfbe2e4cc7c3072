// Order, plateau and performance profile of curves whose answers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "samples/benchmarks/engines/sweep_summary.h"

namespace samples::benchmarks {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SweepCurve curveOf(double order, double floor) {
  SweepCurve curve{"solver", {}};
  for (const int n : {1, 2, 4, 8, 16, 32, 64})
    curve.points.push_back({n, std::max(std::pow(double(n), -order), floor), 10.0 * n, 600.0 * n});
  return curve;
}

TEST(SweepSummary, theOrderOfAPowerLawIsItsExponent) {
  EXPECT_NEAR(*convergenceOrder(curveOf(2.0, 0.0), 0.0), 2.0, 1e-9);
  EXPECT_NEAR(*convergenceOrder(curveOf(1.0, 0.0), 0.0), 1.0, 1e-9);
  EXPECT_NEAR(*convergenceOrder(curveOf(2.0, 1e-2), 1e-2), 2.0, 1e-9) << "what lies on the floor does not count";
}

TEST(SweepSummary, aPlateauAboveTheFloorFailsTheTest) {
  EXPECT_TRUE(plateauTest(curveOf(2.0, 0.0), 0.0)->passed);
  EXPECT_FALSE(plateauTest(curveOf(2.0, 0.05), 1e-3)->passed);
  EXPECT_TRUE(plateauTest(curveOf(2.0, 0.05), 0.05)->passed) << "the floor of floats is no fault of the solver";
  EXPECT_FALSE(plateauTest(curveOf(0.5, 0.0), 0.0)->passed) << "an eighth from 4 to 64 sub-steps, not a quarter";
}

TEST(SweepSummary, theCostOfATargetIsThatOfTheCheapestPointBelowIt) {
  EXPECT_DOUBLE_EQ(costOfTarget(curveOf(1.0, 0.0), 0.25), 2400.0);
  EXPECT_EQ(costOfTarget(curveOf(1.0, 0.1), 0.05), kInfinity);
}

TEST(SweepSummary, theProfileCountsCasesWithinARatioOfTheBest) {
  accuracy::Case easy = *accuracy::findCase("flight"), hard = easy;
  easy.target = 0.6, hard.target = 0.02;
  SweepCurve fast = curveOf(1.0, 0.0), slow = curveOf(2.0, 0.0);
  fast.solver = "fast", slow.solver = "slow";
  for (SweepPoint& p : slow.points) p.ns_per_second *= 3.0;
  const Profile profile = performanceProfile({{&easy, {fast, slow}}, {&hard, {fast, slow}}});
  ASSERT_EQ(profile.curves.size(), 2u);
  // easy: fast 1200 (n = 2), slow 3600; hard: fast 38400 (n = 64), slow 14400 (n = 8).
  EXPECT_DOUBLE_EQ(shareAt(profile, profile.curves[0], 1.0), 0.5);
  EXPECT_DOUBLE_EQ(shareAt(profile, profile.curves[1], 1.0), 0.5);
  EXPECT_DOUBLE_EQ(shareAt(profile, profile.curves[0], 2.7), 1.0);
  EXPECT_DOUBLE_EQ(shareAt(profile, profile.curves[1], 2.7), 0.5);
  EXPECT_DOUBLE_EQ(shareAt(profile, profile.curves[1], 3.0), 1.0);
}

TEST(Sweep, ourPendulumIsBelowItsTargetAndGetsBetterWithTheSquareOfTheSubStep) {
  const SweepOptions options{.substeps = {4, 8, 16}, .repeats = 1, .peers = false};
  const accuracy::Case& pendulum = *accuracy::findCase("pendulum");
  const Sweep sweep = runSweep(pendulum, options);
  ASSERT_FALSE(sweep.curves.empty());
  const SweepCurve& ours = sweep.curves.front();
  ASSERT_EQ(ours.points.size(), 3u);
  EXPECT_LT(std::abs(ours.points[0].error), pendulum.target);
  EXPECT_NEAR(*convergenceOrder(ours, pendulum.floor), 2.0, 0.3);
  for (const SweepPoint& p : ours.points) EXPECT_GT(p.ns_per_step, 0.0);
}

}  // namespace
}  // namespace samples::benchmarks
