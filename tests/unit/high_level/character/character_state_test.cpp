// The table of a character's states, row by row.
#include "pfx/high_level/character/character_state.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace pfx;
using S = CharacterState;
using F = CharacterFacts;

constexpr S kGroundedStates[] = {S::Stand, S::Walk, S::Run, S::Push, S::Climb, S::Crouch, S::Sneak, S::Land};

TEST(CharacterState, OnTheGroundItGoesByWhatIsAsked) {
  for (const S from : {S::Stand, S::Walk, S::Run, S::Push, S::Climb, S::Land}) {
    EXPECT_EQ(nextState(from, {.on_ground = true}), S::Stand);
    EXPECT_EQ(nextState(from, {.on_ground = true, .runs = true}), S::Stand) << "hurry without a direction";
    EXPECT_EQ(nextState(from, {.on_ground = true, .moves = true}), S::Walk);
    EXPECT_EQ(nextState(from, {.on_ground = true, .moves = true, .runs = true}), S::Run);
    EXPECT_EQ(nextState(from, {.on_ground = true, .moves = true, .pushes = true}), S::Push);
    EXPECT_EQ(nextState(from, {.on_ground = true, .moves = true, .pushes = true, .climbs = true}), S::Climb);
    EXPECT_EQ(nextState(from, {.on_ground = true, .crouches = true}), S::Crouch);
    EXPECT_EQ(nextState(from, {.on_ground = true, .moves = true, .crouches = true}), S::Sneak);
  }
}

TEST(CharacterState, WithoutGroundItFallsFromEveryStateThatNeedsGround) {
  for (const S from : kGroundedStates) {
    EXPECT_EQ(nextState(from, {.moves = true}), S::Fall);
    EXPECT_EQ(nextState(from, {.on_steep = true, .moves = true}), S::Slide);
  }
}

TEST(CharacterState, ItJumpsFromEveryGroundedStateWhereItCanStandUp) {
  for (const S from : kGroundedStates)
    EXPECT_EQ(nextState(from, {.on_ground = true, .jumps = true}), S::Jump);
  for (const S from : {S::Crouch, S::Sneak})
    EXPECT_EQ(nextState(from, {.on_ground = true, .jumps = true, .has_headroom = false}), S::Crouch);
  EXPECT_EQ(nextState(S::Fall, {.jumps = true}), S::Fall) << "no jump from the air";
}

TEST(CharacterState, AJumpEndsAtItsTop) {
  EXPECT_EQ(nextState(S::Jump, {.on_ground = true, .rises = true}), S::Jump);
  EXPECT_EQ(nextState(S::Jump, {.rises = false}), S::Fall);
}

TEST(CharacterState, AFallEndsOnGroundAndGoesOnDownASteepSlope) {
  EXPECT_EQ(nextState(S::Fall, {.on_ground = true}), S::Land);
  EXPECT_EQ(nextState(S::Fall, {.on_steep = true}), S::Slide);
  EXPECT_EQ(nextState(S::Fall, {.moves = true, .jumps = true}), S::Fall);
  EXPECT_EQ(nextState(S::Slide, {.on_steep = true, .moves = true, .jumps = true}), S::Slide);
  EXPECT_EQ(nextState(S::Slide, {}), S::Fall);
  EXPECT_EQ(nextState(S::Slide, {.on_ground = true}), S::Stand);
}

TEST(CharacterState, ALandingIsTakenUpBeforeAnythingElse) {
  EXPECT_EQ(nextState(S::Land, {.on_ground = true, .moves = true, .is_recovering = true}), S::Land);
  EXPECT_EQ(nextState(S::Land, {.on_ground = true, .moves = true}), S::Walk);
}

TEST(CharacterState, UnderALowCeilingItStaysLow) {
  EXPECT_EQ(nextState(S::Crouch, {.on_ground = true, .has_headroom = false}), S::Crouch);
  EXPECT_EQ(nextState(S::Sneak, {.on_ground = true, .moves = true, .has_headroom = false}), S::Sneak);
  EXPECT_EQ(nextState(S::Crouch, {.on_ground = true}), S::Stand);
  EXPECT_EQ(nextState(S::Sneak, {.on_ground = true, .moves = true}), S::Walk);
}

TEST(CharacterState, EveryStateHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (int i = 0; i < kNumCharacterStates; ++i) names.insert(toString(static_cast<S>(i)));
  EXPECT_EQ(names.size(), size_t{kNumCharacterStates});
  EXPECT_EQ(toString(static_cast<S>(200)), "unknown");
}

}  // namespace
