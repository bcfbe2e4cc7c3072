// Each scene enters the stages that its content can need and no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "pfx/high_level/pipeline/possible_stages.h"
#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using samples::RunningScene;
using samples::SceneEntry;
using Names = std::set<std::string_view>;

Names setOf(const std::vector<std::string_view>& names) { return {names.begin(), names.end()}; }

// What `vitrine list` prints: the scene is built and its script prepares the first step, which is not made.
Names possibleStagesOf(const SceneEntry& entry) {
  RunningScene run(entry);
  run.scene->beforeStep(run.world, samples::kTimeStep);
  return setOf(possibleStages(run.world));
}

class SceneStages : public testing::TestWithParam<SceneEntry> {};

TEST_P(SceneStages, AreThoseOfItsContentAndNoOther) {
  const Names possible = possibleStagesOf(GetParam());
  RunningScene run(GetParam());
  Names entered;  // step by step, as the timer saw them
  for (int i = 0; i < 60; ++i) {
    run.step();
    for (const StageTime& t : run.world.stageTimes()) entered.insert(t.name);
  }
  EXPECT_EQ(setOf(run.world.stages()), entered);
  for (std::string_view stage : entered) EXPECT_TRUE(possible.contains(stage)) << stage << " is not listed";
  for (std::string_view stage : {"particles", "joints", "break joints", "broad phase"})
    EXPECT_EQ(entered.contains(stage), possible.contains(stage)) << stage;
}

INSTANTIATE_TEST_SUITE_P(All, SceneStages, testing::ValuesIn(samples::scenes().begin(), samples::scenes().end()),
                         [](const auto& scene) { return samples::testName(scene.param); });

Names possibleStagesOf(std::string_view target) { return possibleStagesOf(*samples::findScenes(target).front()); }

// What a scene does not have is not listed.
TEST(PossibleStages, AreFewWhereThereIsLittle) {
  EXPECT_EQ(possibleStagesOf("accuracy/free_top"), Names({"free flight"}));
  EXPECT_EQ(possibleStagesOf("5_raycast/filter"), Names({"broad phase"}));
  EXPECT_FALSE(possibleStagesOf("1_simple/tower").contains("store impulses"));
  EXPECT_TRUE(possibleStagesOf("2_stable/tower").contains("store impulses"));
  EXPECT_FALSE(possibleStagesOf("2_stable/tower").contains("sleep"));
  EXPECT_TRUE(possibleStagesOf("3_sleep/tower").contains("sleep"));
  EXPECT_FALSE(possibleStagesOf("5_raycast/landscape").contains("moving meshes"));
  EXPECT_TRUE(possibleStagesOf("8_deform_mesh/wave").contains("moving meshes"));
}

TEST(PossibleStages, ARemovedBodyNeedsNone) {
  World world;
  const BodyId ball = world.addBody({.name = "ball", .shapes = {Shape{Sphere{1.0f}, {}}}});
  EXPECT_EQ(setOf(possibleStages(world)), Names({"free flight"}));
  world.removeBody(ball);
  EXPECT_TRUE(possibleStages(world).empty());
}

}  // namespace
