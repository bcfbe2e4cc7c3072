// Sample 10_character_ctrl: the scripted course, as measured.
#include <gtest/gtest.h>

#include <map>

#include "tests/files/scene_run.h"

namespace {

using namespace samples;

double reading(const RunningScene& run, std::string_view name) {
  for (const Reading& r : run.scene->readings(run.world))
    if (r.name == name) return r.value;
  throw std::logic_error("no such reading: " + std::string(name));
}

constexpr int kMinute = 3600;

TEST(CharacterCourse, ReachesEveryStateInAMinuteAndRepeatsToTheBit) {
  const SceneEntry& entry = *findScenes("10_character_ctrl/course").front();
  RunningScene first(entry), second(entry);
  for (int i = 0; i < kMinute; ++i) {
    first.step(), second.step();
    if (i % 60 != 59) continue;
    ASSERT_EQ(first.world.stateHash(), second.world.stateHash()) << "step " << i;
    ASSERT_EQ(first.scene->stateHash(), second.scene->stateHash()) << "step " << i;
  }
  EXPECT_EQ(reading(first, "states reached, of 11"), 11.0);
  EXPECT_LT(reading(first, "rider's drift on the turntable"), 1.0) << "mm";
  EXPECT_LT(reading(first, "overlap of two characters"), 20.0) << "mm";
  EXPECT_NEAR(reading(first, "height of the last jump"), reading(first, "v^2 / 2g of a jump"), 0.002);
  for (const auto& r : first.scene->readings(first.world))
    RecordProperty(std::string(r.name), std::to_string(r.value));
}

TEST(CharacterCourse, APersonTakesOver) {
  const SceneEntry& entry = *findScenes("10_character_ctrl/course").front();
  RunningScene run(entry);
  ASSERT_TRUE(run.scene->isControlled());
  const auto hero = [&] {
    for (uint32_t i = 0; i < run.world.states().size(); ++i)
      if (run.world.name(i) == "hero") return run.world.states()[i].position;
    throw std::logic_error("no hero");
  };
  const pfx::Vec3 from = hero();
  // Seen from behind (yaw 0) forward is -z.
  run.scene->control({.forward = 1.0f, .run = true});
  for (int i = 0; i < 50; ++i) run.step();
  EXPECT_LT(hero().z() - from.z(), -2.0f);
  EXPECT_NEAR(hero().x(), from.x(), 0.05f);
  const float low = hero().y();
  run.scene->control({.jump = true});
  for (int i = 0; i < 20; ++i) run.step();
  EXPECT_GT(hero().y() - low, 0.6f);
}

TEST(CharacterSlopes, SixtyDegreesAndFortyCentimetresAreRefused) {
  RunningScene run(*findScenes("10_character_ctrl/slopes_and_steps").front());
  for (int i = 0; i < 480; ++i) run.step();
  EXPECT_LT(reading(run, "climb of the two that are refused"), 10.0) << "mm";
  EXPECT_NEAR(reading(run, "speed along the slope of 30 degrees"), 1.6, 0.02);
  int up = 0;
  for (uint32_t i = 0; i < run.world.states().size(); ++i)
    up += run.world.name(i).starts_with("climber") && run.world.states()[i].position.y() > 3.0f;
  EXPECT_EQ(up, 6);
}

TEST(CharacterCrowd, SixteenCrossWithoutOverlap) {
  RunningScene run(*findScenes("10_character_ctrl/crowd").front());
  for (int i = 0; i < 840; ++i) run.step();
  EXPECT_LT(reading(run, "overlap of two characters"), 20.0) << "mm";
  EXPECT_GE(reading(run, "on the far side, of 16"), 12.0);
}

}  // namespace
