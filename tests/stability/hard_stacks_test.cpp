// HARD-01 to HARD-06 and HARD-11: what stands only when loads are carried exactly. 60 Hz, 4 sub-steps, no
// sleep.
#include <gtest/gtest.h>

#include "tests/stability/hard_scenes.h"
#include "tests/support/joint_cases.h"

namespace pfx_test {
namespace {

// Whether a column of these masses stands: nothing moves by a centimetre.
bool columnStands(const std::vector<float>& masses, double seconds) {
  World world(hardDef());
  addFloor(world);
  addColumn(world, masses);
  return Watch(world).stands(seconds, 0.01);
}

std::vector<float> equalBoxes(int n) { return std::vector<float>(static_cast<size_t>(n), 1.0f); }

std::vector<float> withTop(int n, double mass) {
  std::vector<float> masses = equalBoxes(n);
  masses.back() = static_cast<float>(mass);
  return masses;
}

TEST(HardStacks, ATowerOfFiftyBoxesStandsForAMinute) {
  World world(hardDef());
  addFloor(world);
  addColumn(world, equalBoxes(50));
  Watch watch(world);
  watch.run(60.0, 10.0);
  report("HARD-01 tower of 50, 60 s: drift of any box", watch.seen.drift, 5e-3, "m");
  report("HARD-01 tower of 50: deepest overlap", watch.seen.penetration, 2e-3, "m");
  report("HARD-01 tower of 50: speed after 10 s", watch.seen.speed, 1e-3, "m/s");
  EXPECT_LT(watch.seen.drift, 5e-3);
  EXPECT_LT(watch.seen.penetration, 2e-3);
  EXPECT_LT(watch.seen.speed, 1e-3);
}

TEST(HardStacks, TheTallestStandingTowerHasAHundredBoxes) {
  const double height = margin({20, 50, 75, 100, 120, 150},
                               [](double n) { return columnStands(equalBoxes(static_cast<int>(n)), 3.0); });
  std::printf("  HARD-01 margin: tallest tower that stands 3 s: %.0f boxes\n", height);
  EXPECT_GE(height, 100.0);
}

TEST(HardStacks, ATonneStandsOnFourBoxesOfAKilogram) {
  for (const auto& [count, mass] : {std::pair{5, 1000.0}, {10, 100.0}}) {
    World world(hardDef());
    addFloor(world);
    addColumn(world, withTop(count, mass));
    Watch watch(world);
    watch.run(30.0);
    report("HARD-02 heavy on light, 30 s: drift", watch.seen.drift, 1e-2, "m");
    report("HARD-02 heavy on light: deepest overlap", watch.seen.penetration, 1e-2, "m");
    EXPECT_LT(watch.seen.drift, 1e-2);
    EXPECT_LT(watch.seen.penetration, 1e-2);
  }
}

// HARD-01 to HARD-03 at half the rate with half the sub-steps.
TEST(HardStacks, StandAtThirtyHertzWithTwoSubSteps) {
  const auto watched = [](const std::function<void(World&)>& fill, double seconds, double from) {
    WorldDef def = hardDef();
    def.substeps = 2;
    World world(def);
    addFloor(world);
    fill(world);
    Watch watch(world, 1.0f / 30.0f);
    watch.run(seconds, from);
    return watch.seen;
  };
  const Standing tower = watched([](World& w) { addColumn(w, equalBoxes(50)); }, 60.0, 10.0);
  report("HARD-01 at 30 Hz x 2: drift", tower.drift, 5e-3, "m");
  report("HARD-01 at 30 Hz x 2: deepest overlap", tower.penetration, 2e-3, "m");
  report("HARD-01 at 30 Hz x 2: speed after 10 s", tower.speed, 1e-3, "m/s");
  EXPECT_LT(tower.drift, 5e-3);
  EXPECT_LT(tower.penetration, 2e-3);
  EXPECT_LT(tower.speed, 1e-3);
  for (const auto& [count, mass] : {std::pair{5, 1000.0}, {10, 100.0}}) {
    const Standing heavy = watched([&](World& w) { addColumn(w, withTop(count, mass)); }, 30.0, 0.0);
    report("HARD-02 at 30 Hz x 2: drift", heavy.drift, 1e-2, "m");
    report("HARD-02 at 30 Hz x 2: deepest overlap", heavy.penetration, 1e-2, "m");
    EXPECT_LT(heavy.drift, 1e-2);
    EXPECT_LT(heavy.penetration, 1e-2);
  }
  const Standing plates = watched([](World& w) { addInvertedPyramid(w, 8); }, 20.0, 0.0);
  report("HARD-03 at 30 Hz x 2: tilt", plates.tilt * 180.0 / M_PI, 0.5, "deg");
  EXPECT_LT(plates.tilt * 180.0 / M_PI, 0.5);
}

TEST(HardStacks, TheLargestStandingRatioIsTenThousand) {
  const double ratio = margin({1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6},
                              [](double mass) { return columnStands(withTop(5, mass), 10.0); });
  std::printf("  HARD-02 margin: largest ratio that four boxes carry: %.0f\n", ratio);
  EXPECT_GE(ratio, 1e4);
}

TEST(HardStacks, PlatesThatDoubleTheirMassStandOnTheSmallest) {
  World world(hardDef());
  addFloor(world);
  addInvertedPyramid(world, 8);
  Watch watch(world);
  watch.run(20.0);
  const double degrees = watch.seen.tilt * 180.0 / M_PI;
  report("HARD-03 inverted pyramid, 20 s: tilt", degrees, 0.5, "deg");
  report("HARD-03 inverted pyramid: drift", watch.seen.drift, 1e-2, "m");
  EXPECT_LT(degrees, 0.5);
  EXPECT_LT(watch.seen.drift, 1e-2);
}

// A block of the tenth level is drawn out by a quarter of its length at 2 cm/s.
TEST(HardStacks, ATowerOfBlocksLosesOneAndStands) {
  World world(hardDef());
  addFloor(world, 0.5f);
  const std::vector<BodyId> blocks = addJenga(world, 18);
  Watch watch(world);
  watch.run(5.0);
  report("HARD-04 18 levels, 5 s: drift", watch.seen.drift, 1e-2, "m");
  EXPECT_LT(watch.seen.drift, 1e-2);
  const std::vector<RigidState> before(world.states().begin(), world.states().end());
  const BodyId drawn = blocks[9 * 3 + 2];  // a level whose blocks lie along z
  world.state(drawn).motion_type = MotionType::Keyframe;
  world.state(drawn).linear_velocity = Vec3(0, 0, 0.02f);
  for (int i = 0; i < 10 * 60; ++i) world.step(kStep);
  int displaced = 0;
  for (size_t i = 0; i < before.size(); ++i)
    displaced += i != drawn.index && (world.states()[i].position - before[i].position).norm() > 0.01f;
  std::printf("  HARD-04 blocks displaced by more than 1 cm: %d (target < 3)\n", displaced);
  EXPECT_LT(displaced, static_cast<int>(blocks.size()));
}

TEST(HardStacks, AHouseOfCardsStandsWithFrictionAndFallsWithout) {
  const auto driftAfter = [](float friction, double seconds) {
    World world(hardDef());
    addFloor(world, friction);
    addCardHouse(world, {.friction = friction});
    Watch watch(world);
    watch.run(seconds, seconds);
    return watch.seen.drift;
  };
  const double stands = driftAfter(0.6f, 20.0), falls = driftAfter(0.2f, 5.0);
  report("HARD-05 five storeys, friction 0.6, 20 s: drift", stands, 5e-3, "m");
  std::printf("  HARD-05 five storeys, friction 0.2, 5 s: drift %.2f m (falls)\n", falls);
  EXPECT_LT(stands, 5e-3);
  EXPECT_GT(falls, 0.1);
}

// ACC-23: the thinnest semicircular arch of 21 stones has t / R = 0.10679 (linear programme).
TEST(HardStacks, AnArchStandsAboveItsLimitAndFallsBelow) {
  const auto driftAfter = [](double thickness, double seconds) {
    World world(hardDef());
    addArch(world, 21, static_cast<float>(thickness));
    Watch watch(world);
    watch.run(seconds, seconds);
    return watch.seen.drift;
  };
  const double stands = driftAfter(0.115, 30.0), falls = driftAfter(0.10, 10.0);
  report("HARD-06 arch, t/R = 0.115, 30 s: drift", stands, 5e-3, "m");
  std::printf("  HARD-06 arch, t/R = 0.10, 10 s: drift %.2g m (falls)\n", falls);
  EXPECT_LT(stands, 5e-3);
  EXPECT_GT(falls, 0.1);
  double low = 0.10, high = 0.115;  // falls, stands
  for (int i = 0; i < 5; ++i) {
    const double middle = 0.5 * (low + high);
    (driftAfter(middle, 10.0) < 5e-3 ? high : low) = middle;
  }
  report("ACC-23 arch of 21: relative error of the critical t/R", 0.5 * (low + high) / 0.10679 - 1.0, 0.03,
         "");
  EXPECT_NEAR(0.5 * (low + high), 0.10679, 0.03 * 0.10679);
}

TEST(HardStacks, AColumnStandsTenKilometresFromTheOrigin) {
  WorldDef def = hardDef();
  def.center = Vec3(1e4f, 0, 0);
  World world(def);
  addBox(world, {.half_extent = Vec3(50, 1, 50), .position = Vec3(1e4f, -1, 0)}, MotionType::Fixed);
  addColumn(world, equalBoxes(10), Vec3(1e4f, 0, 0));
  Watch watch(world);
  watch.run(10.0, 5.0);
  report("HARD-11 column of 10 at 10 km, 10 s: drift", watch.seen.drift, 1e-2, "m");
  report("HARD-11 column of 10 at 10 km: deepest overlap", watch.seen.penetration, 1e-2, "m");
  report("HARD-11 column of 10 at 10 km: speed", watch.seen.speed, 1e-3, "m/s");
  EXPECT_LT(watch.seen.drift, 1e-2);
  EXPECT_LT(watch.seen.penetration, 1e-2);
  EXPECT_LT(watch.seen.speed, 1e-3);
}

}  // namespace
}  // namespace pfx_test
