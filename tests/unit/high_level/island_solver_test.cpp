// Islands that the island solver takes: which, with what result for the rest, and the same for any number of
// workers.
#include <gtest/gtest.h>

#include <algorithm>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

constexpr float kStep = 1.0f / 60.0f;

void addColumns(World& world, int columns, int height) {
  const auto box = [&](const Vec3& at, const Vec3& half, MotionType type) {
    world.addBody(
        {.pose = {.position = at}, .motion_type = type, .shapes = {{Box{half}}}, .restitution = 0.0f});
  };
  box(Vec3(0, -1, 0), Vec3(50, 1, 50), MotionType::Fixed);
  for (int c = 0; c < columns; ++c)
    for (int i = 0; i < height; ++i)
      box(Vec3(3.0f * static_cast<float>(c), 0.5f + static_cast<float>(i), 0), Vec3::Constant(0.5f),
          MotionType::Active);
}

// Whether the last step went through a stage.
bool uses(const World& world, std::string_view stage) {
  const auto times = world.stageTimes();
  return std::any_of(times.begin(), times.end(), [&](const StageTime& t) { return t.name == stage; });
}

TEST(IslandSolver, TakesATallColumnAndLeavesAShortOne) {
  for (const auto& [height, taken] : {std::pair{12, true}, {3, false}}) {
    World world;
    addColumns(world, 1, height);
    for (int i = 0; i < 60; ++i) world.step(kStep);
    EXPECT_EQ(uses(world, "island solver"), taken) << height << " boxes";
    EXPECT_EQ(uses(world, "solve"), !taken) << height << " boxes";
  }
}

TEST(IslandSolver, TakesAllOrNoneWhereTheWorldSaysSo) {
  for (const auto& [solver, taken] : {std::pair{ContactSolver::Newton, true}, {ContactSolver::Soft, false}}) {
    WorldDef def;
    def.contact_solver = solver;
    World world(def);
    addColumns(world, 2, 8);
    for (int i = 0; i < 60; ++i) world.step(kStep);
    EXPECT_EQ(uses(world, "island solver"), taken);
  }
}

// What a column weighs is what its contacts carry, to a ten-thousandth.
TEST(IslandSolver, ContactsCarryTheWeightAboveThem) {
  World world;
  addColumns(world, 1, 30);
  for (int i = 0; i < 300; ++i) world.step(kStep);
  const float h = kStep / static_cast<float>(world.def().substeps);
  for (const Pair& pair : world.contactPairs()) {
    float impulse = 0.0f;
    for (const ContactManifold& m : world.manifolds(pair))
      for (int i = 0; i < m.num_points; ++i) impulse += m.points[i].normal_impulse;
    const float above = static_cast<float>(31 - std::max(pair.body_a, pair.body_b));
    EXPECT_NEAR(impulse / (h * 9.8f), above, 1e-4f * above);
  }
}

TEST(IslandSolver, TheStateIsTheSameForAnyNumberOfWorkers) {
  const auto hashWith = [](int workers) {
    WorldDef def;
    def.workers = workers;
    World world(def);
    addColumns(world, 5, 12);
    for (int i = 0; i < 120; ++i) world.step(kStep);
    return world.stateHash();
  };
  const uint64_t one = hashWith(1);
  for (const int workers : {2, 3, 4}) EXPECT_EQ(hashWith(workers), one) << workers << " workers";
}

}  // namespace
