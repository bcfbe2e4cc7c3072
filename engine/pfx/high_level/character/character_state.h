// The states of a character and the table that leads from one to the next.
//
// Pure: what is asked of the character and what is found around it come in as facts, so that every transition
// can be tested without a world.
#pragma once

#include <cstdint>
#include <string_view>

namespace pfx {

enum class CharacterState : uint8_t {
  Stand,
  Walk,
  Run,
  Push,    // walks against a body that can give way
  Climb,   // goes up a step
  Crouch,  // stands low
  Sneak,   // walks low
  Jump,    // on its way up
  Fall,
  Land,   // takes up a fall
  Slide,  // on ground too steep to stand on
};
inline constexpr int kNumCharacterStates = 11;

std::string_view toString(CharacterState state);

struct CharacterFacts {
  bool on_ground = false;      // something that can be walked on carries it
  bool on_steep = false;       // only something too steep does
  bool rises = false;          // moves up against what it left
  bool moves = false;          // asked to go somewhere
  bool runs = false;           // asked to hurry
  bool jumps = false;          // asked to jump, anew since the last jump
  bool crouches = false;       // asked to stay low
  bool has_headroom = true;    // could stand upright
  bool pushes = false;         // a body that can give way is in the way
  bool climbs = false;         // a step that it can take is in the way
  bool is_recovering = false;  // the last landing is not taken up yet
};

CharacterState nextState(CharacterState state, const CharacterFacts& facts);

constexpr bool isLow(CharacterState s) { return s == CharacterState::Crouch || s == CharacterState::Sneak; }
// Carried by ground that can be walked on.
constexpr bool isGrounded(CharacterState s) {
  return s != CharacterState::Jump && s != CharacterState::Fall && s != CharacterState::Slide;
}

}  // namespace pfx
