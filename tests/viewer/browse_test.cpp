// The browser without its window: keys, input latching, search, settings, and the session with its past.
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Keys, NoKeyHasTwoCommands) {
  std::set<std::tuple<int, bool, bool>> keys;
  for (const KeyBinding& b : keyBindings()) {
    EXPECT_TRUE(keys.insert({b.key, b.control, b.shift}).second) << b.keys;
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

TEST(UiInput, WhatIsTypedAfterTheShortcutOfAFieldWaitsUntilTheFieldHasTheKeyboard) {
  UiInput input;
  WindowInput window;
  window.keys = {{'O', true, false, true, false, false}, {'2', true, false, false, false, false}};
  window.characters = {'2'};
  input.add(window);
  const UiInput::Frame shortcut = input.next();
  EXPECT_TRUE(shortcut.isDown('O'));
  EXPECT_FALSE(shortcut.isDown('2')) << "it would be taken for a shortcut of its own";
  input.keepTyping(2);
  for (int i = 0; i < 2; ++i) {
    const UiInput::Frame kept = input.next();
    EXPECT_TRUE(kept.keys.empty() && kept.characters.empty());
    EXPECT_TRUE(input.waiting());
  }
  const UiInput::Frame typed = input.next();
  EXPECT_TRUE(typed.isDown('2'));
  EXPECT_EQ(typed.characters, std::vector<uint32_t>{'2'});
  EXPECT_FALSE(input.waiting());
}

TEST(UiInput, AClickIsSeenWhereItWasMadeThoughTheMouseHasMovedOn) {
  UiInput input;
  WindowInput window;
  window.buttons = {{0, true, 10, 20}, {0, false, 10, 20}};
  window.mouse_x = 90, window.mouse_y = 80;
  input.add(window);
  const UiInput::Frame press = input.next();
  EXPECT_TRUE(press.held[0]);
  EXPECT_EQ(press.mouse_x, 10);
  const UiInput::Frame release = input.next();
  EXPECT_FALSE(release.held[0]);
  EXPECT_EQ(release.mouse_y, 20);
  EXPECT_EQ(input.next().mouse_x, 90);
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

TEST_F(SessionTest, SubStepsChangeWhileItRunsAndSteppingBackKnowsIt) {
  session.stepForward(10);
  const uint64_t before = session.world().stateHash();
  pfx::SolverSettings finer = session.world().solver();
  finer.substeps *= 2;
  session.give(finer);
  EXPECT_EQ(session.world().stateHash(), before) << "the scene was not built again";
  session.stepForward(140);
  const uint64_t at_150 = session.world().stateHash();
  session.seek(5);
  EXPECT_EQ(session.world().solver().substeps, finer.substeps / 2);
  session.seek(150);
  session.seek(100);
  EXPECT_EQ(session.world().solver().substeps, finer.substeps);
  session.stepForward(50);
  EXPECT_EQ(session.world().stateHash(), at_150);

  Session unchanged;
  const std::vector<SceneSpec> scenes = allScenes();
  unchanged.load(findScene(scenes, "2_stable/primitives"));
  unchanged.stepForward(150);
  EXPECT_NE(unchanged.world().stateHash(), at_150);
}

TEST_F(SessionTest, ARecordingAfterARestartWithAnotherSolverRepeats) {
  session.settings.contact_solver = pfx::ContactSolver::Newton;
  session.restart();
  session.startRecording();
  session.stepForward(120);
  const Recording recording(session.stopRecording(), "newton");
  Session again;
  again.open(recording);
  again.stepForward(120);
  EXPECT_EQ(again.step(), 120u);
  EXPECT_FALSE(again.divergence());
}

TEST(SessionCosts, OfStagesThatAStepDidNotNeedAreZero) {
  Session session;
  const std::vector<SceneSpec> scenes = allScenes();
  session.load(findScene(scenes, "2_stable/primitives"));
  session.stepForward(int(Session::kRecent));
  bool some_rested = false;
  float sum = 0.0f;
  for (const StageCost& cost : session.costs()) {
    ASSERT_EQ(cost.recent.size(), session.totals().size()) << cost.name;
    const auto [least, most] = std::minmax_element(cost.recent.begin(), cost.recent.end());
    some_rested = some_rested || (*least == 0.0f && *most > 0.0f);
    sum += cost.recent.back();
  }
  EXPECT_TRUE(some_rested) << "nothing touches at first";
  EXPECT_NEAR(sum, session.totals().back(), 1e-4f);
}

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

// The hash after so many steps of a session in which a ball was thrown after 20 and a body pulled from 30 to 50.
uint64_t playWithHands(Session& session, uint64_t steps) {
  while (session.step() < steps) {
    if (session.step() == 20) session.give(ThrowBall{pfx::Vec3(0, 3, 12), pfx::Vec3(0, 0, -20), 0.4f});
    if (session.step() == 30) session.grab = Grab{session.world().bodyId(2), pfx::Vec3::Zero(), pfx::Vec3(1, 6, 0)};
    if (session.step() == 50) session.grab.reset();
    session.stepForward();
  }
  return session.world().stateHash();
}

TEST_F(SessionTest, SteppingBackOverAThrowAndAPullAndForwardAgainGivesTheSameBits) {
  const uint64_t at_80 = playWithHands(session, 80);
  for (const uint64_t step : {60u, 40u, 25u, 21u, 0u}) {
    session.seek(step);
    EXPECT_EQ(session.world().stateHash(), session.remembered(step)->state_hash) << step;
    EXPECT_TRUE(session.isExact());
    // Whatever is asked about the step is there.
    for (uint32_t i = 0; i < session.world().numIslands(); ++i)
      for (uint32_t body : session.world().island(i).bodies) ASSERT_LT(body, session.world().states().size());
  }
  session.seek(80);
  EXPECT_EQ(session.world().stateHash(), at_80);
}

TEST_F(SessionTest, GoingOnAfterAThrowWasSteppedOverKeepsIt) {
  playWithHands(session, 80);
  const uint64_t at_60 = session.remembered(60)->state_hash;
  const uint64_t at_55 = session.remembered(55)->state_hash;
  session.seek(55);
  EXPECT_EQ(session.world().stateHash(), at_55);
  session.paused = false;
  session.advance(1.0 / 60.0 + 1e-6);
  EXPECT_EQ(session.lastStep(), 56u);
  session.stepForward(4);
  EXPECT_EQ(session.world().stateHash(), at_60);
}

TEST_F(SessionTest, GoingOnFromBeforeAThrowForgetsIt) {
  const uint32_t bodies = session.world().counts().bodies;
  session.stepForward(10);
  session.give(ThrowBall{pfx::Vec3(0, 10, 20), pfx::Vec3(0, 0, -20), 0.3f});
  session.stepForward(5);
  session.seek(10);
  session.paused = false;
  session.advance(1.0 / 60.0 + 1e-6);
  EXPECT_EQ(session.world().counts().bodies, bodies);
}

// A scene that remembers something outside of the world cannot go back by snapshots alone.
TEST(SessionOfAScriptedScene, GoesOnFromThePastWithTheSameBits) {
  const std::vector<SceneSpec> scenes = allScenes();
  Session session;
  session.load(findScene(scenes, "4_motion_type/keyframe"));
  session.stepForward(120);
  const uint64_t at_120 = session.world().stateHash(), at_50 = session.remembered(50)->state_hash;
  session.seek(50);
  EXPECT_EQ(session.world().stateHash(), at_50);
  session.seek(120);
  EXPECT_EQ(session.world().stateHash(), at_120);
  session.seek(50);
  session.paused = false;
  session.advance(1.0 / 60.0 + 1e-6);
  session.stepForward(69);
  EXPECT_EQ(session.step(), 120u);
  EXPECT_EQ(session.world().stateHash(), at_120);
}

TEST_F(SessionTest, ARecordingFromTheMiddleIsRepeatedBitForBit) {
  session.stepForward(25);
  session.startRecording();
  playWithHands(session, 70);
  const uint64_t at_70 = session.world().stateHash();
  const Recording recording(session.stopRecording(), "middle");
  EXPECT_EQ(recording.numFrames(), 46u);
  Session again;
  again.open(recording);
  EXPECT_EQ(again.firstStep(), 25u);
  EXPECT_EQ(again.lastStep(), 70u);
  again.stepForward(100);
  EXPECT_EQ(again.step(), 70u);
  EXPECT_EQ(again.divergence(), std::nullopt);
  EXPECT_EQ(again.world().stateHash(), at_70);
  again.seek(40);
  EXPECT_EQ(again.world().stateHash(), session.remembered(40)->state_hash);
}

TEST_F(SessionTest, TheFirstStepThatARecordingIsNotRepeatedInIsMarked) {
  session.stepForward(40);
  RecordingWriter writer({.target = "2_stable/primitives", .dt = session.timeStep(), .substeps = 4});
  for (uint64_t step = 0; step <= 40; ++step) {
    RecordedFrame frame = *session.remembered(step);
    if (step >= 30) {
      frame.bodies[1].position.x() += 0.001f;
      frame.state_hash ^= 1;
    }
    writer.add(frame);
  }
  Session replay;
  replay.open(Recording(writer.bytes(), "changed"));
  replay.stepForward(100);
  EXPECT_EQ(replay.divergence(), 30u);
  // What is shown is what was recorded.
  EXPECT_EQ(replay.world().states()[1].position.x(), session.remembered(40)->bodies[1].position.x() + 0.001f);
  EXPECT_FALSE(replay.isExact());
}

TEST_F(SessionTest, AThrownBallIsABodyMore) {
  const uint32_t before = session.world().counts().bodies;
  session.give(ThrowBall{pfx::Vec3(0, 10, 20), pfx::Vec3(0, 0, -20), 0.3f});
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
