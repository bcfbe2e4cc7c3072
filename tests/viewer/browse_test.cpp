// The browser without its window: keys, input latching, search, settings, and the session with its past.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "viewer/browse/commands.h"
#include "viewer/browse/session.h"
#include "viewer/browse/settings.h"
#include "viewer/browse/ui_input.h"
#include "viewer/file.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

TEST(Keys, EveryCommandHasOneKeyAndNoKeyHasTwoCommands) {
  std::set<std::tuple<int, bool, bool>> keys;
  std::set<BrowseCommand> commands;
  for (const KeyBinding& b : keyBindings()) {
    EXPECT_TRUE(keys.insert({b.key, b.control, b.shift}).second) << b.keys;
    EXPECT_TRUE(commands.insert(b.command).second) << b.help;
    EXPECT_EQ(commandOf({b.key, true, false, b.control, b.shift, false}), b.command);
    EXPECT_EQ(commandOf({b.key, false, false, b.control, b.shift, false}), std::nullopt);
  }
}

TEST(UiInput, APressAndReleaseInOneFrameAreBothSeen) {
  UiInput input;
  WindowInput window;
  window.buttons = {{0, true}, {0, false}};
  window.keys = {{'R', true, false, false, false, false}, {'R', false, false, false, false, false}};
  input.add(window);
  const UiInput::Frame first = input.next();
  EXPECT_TRUE(first.held[0]);
  EXPECT_TRUE(first.isDown('R'));
  EXPECT_TRUE(input.waiting());
  const UiInput::Frame second = input.next();
  EXPECT_FALSE(second.held[0]);
  EXPECT_FALSE(second.isDown('R'));
  EXPECT_FALSE(input.waiting());
}

TEST(UiInput, ALostFocusReleasesEverything) {
  UiInput input;
  WindowInput window;
  window.keys = {{'W', true, false, false, false, false}};
  window.buttons = {{1, true}};
  input.add(window);
  input.next();
  WindowInput away;
  away.focused = false;
  input.add(away);
  const UiInput::Frame& frame = input.next();
  EXPECT_FALSE(frame.isDown('W'));
  EXPECT_FALSE(frame.held[1]);
}

TEST(Search, LettersInOrderMatchWhateverTheirCase) {
  EXPECT_TRUE(matchesFilter("2_stable/tower", ""));
  EXPECT_TRUE(matchesFilter("2_stable/tower", "TOW"));
  EXPECT_TRUE(matchesFilter("2_stable/tower", "stw"));
  EXPECT_FALSE(matchesFilter("2_stable/tower", "wot"));
}

class SettingsFile : public testing::Test {
 protected:
  std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "vitrine_settings_test";
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(SettingsFile, WhatWasWrittenIsReadBack) {
  BrowseSettings s;
  s.width = 900;
  s.target = "2_stable/tower";
  s.speed = 0.5f;
  s.show_costs = true;
  s.overlays.contacts = s.overlays.islands = true;
  writeSettings(folder / "new" / "browse.json", s);
  EXPECT_EQ(readSettings(folder / "new" / "browse.json"), s);
}

TEST_F(SettingsFile, DamagedOrStrangeSettingsGiveDefaults) {
  EXPECT_EQ(readSettings(folder / "missing.json"), BrowseSettings{});
  for (const char* text :
       {"", "{", "[]", R"({"width": "wide", "speed": -3, "overlays": "nonsense"})", R"({"target": 7})"}) {
    writeText(folder / "bad.json", text);
    EXPECT_EQ(readSettings(folder / "bad.json"), BrowseSettings{}) << text;
  }
  writeText(folder / "huge.json", R"({"width": 1000000, "height": -5})");
  EXPECT_EQ(readSettings(folder / "huge.json").width, 7680);
  EXPECT_EQ(readSettings(folder / "huge.json").height, 240);
}

class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<SceneSpec> scenes = allScenes();
    session.load(findScene(scenes, "2_stable/primitives"));
  }
  Session session;
};

TEST_F(SessionTest, SteppingBackShowsEarlierPosesAndForwardAgainTheSameFuture) {
  session.stepForward(30);
  const uint64_t at_30 = session.world().stateHash();
  session.stepForward(30);
  const uint64_t at_60 = session.world().stateHash();
  session.seek(30);
  EXPECT_EQ(session.step(), 30u);
  EXPECT_EQ(session.world().stateHash(), at_30);
  EXPECT_EQ(session.lastStep(), 60u);
  session.stepForward(30);
  EXPECT_EQ(session.world().stateHash(), at_60);
}

TEST_F(SessionTest, GoingOnFromThePastLeadsToTheSameBits) {
  session.stepForward(90);
  const uint64_t at_90 = session.world().stateHash();
  session.seek(20);
  session.paused = false;
  session.advance(1.0 / 60.0 + 1e-6);  // one step is due
  EXPECT_EQ(session.step(), 21u);
  EXPECT_EQ(session.lastStep(), 21u);
  session.stepForward(69);
  EXPECT_EQ(session.world().stateHash(), at_90);
}

TEST_F(SessionTest, NothingMovesWhilePaused) {
  session.paused = true;
  session.advance(1.0);
  EXPECT_EQ(session.step(), 0u);
}

TEST_F(SessionTest, SeekingOutsideOfTheTimelineStopsAtItsEnds) {
  session.stepForward(5);
  session.seek(1000);
  EXPECT_EQ(session.step(), 5u);
  session.stepBack(1000);
  EXPECT_EQ(session.step(), 0u);
}

TEST_F(SessionTest, AThrownBallIsABodyMore) {
  const uint32_t before = session.world().counts().bodies;
  session.throwBall(pfx::Vec3(0, 10, 20), pfx::Vec3(0, 0, -20), 0.3f);
  session.stepForward(3);
  EXPECT_EQ(session.world().counts().bodies, before + 1);
  session.stepBack(2);
  session.stepForward(4);
  EXPECT_EQ(session.world().counts().bodies, before + 1);
}

TEST_F(SessionTest, APulledBodyFollowsTheMouse) {
  const pfx::BodyId body = session.world().bodyId(1);
  const pfx::Vec3 target = session.world().states()[1].position + pfx::Vec3(0, 2, 0);
  session.grab = Grab{body, pfx::Vec3::Zero(), target};
  session.stepForward(120);
  // Half a spring against gravity: g / (kRate^2 / 2) = 0.2 m below the mouse when at rest.
  EXPECT_NEAR(session.world().states()[1].position.y(), target.y() - 0.196f, 0.05f);
}

}  // namespace
}  // namespace viewer
