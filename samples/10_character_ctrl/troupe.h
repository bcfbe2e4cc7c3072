// Several characters of a scene: who they are, what is asked of them, and what they have shown so far.
#pragma once

#include <array>
#include <vector>

#include "pfx/high_level/character/character.h"
#include "samples/10_character_ctrl/actor.h"
#include "samples/scene.h"

namespace samples {

class Troupe {
 public:
  // The index of a new character.
  size_t add(pfx::World& world, const pfx::CharacterDef& def, const Outfit& outfit);

  size_t size() const { return characters_.size(); }
  const pfx::Character& operator[](size_t i) const { return characters_[i]; }
  pfx::CharacterInput& input(size_t i) { return inputs_[i]; }
  std::span<pfx::Character> characters() { return characters_; }

  void beforeStep(pfx::World& world, float dt);
  void afterStep(const pfx::World& world, float dt);
  void draw(const pfx::World& world, Canvas& canvas, bool labelled = true) const;
  uint64_t stateHash() const { return pfx::hashCharacters(characters_); }

  int statesReached() const;  // of all that any of them was in
  bool reached(pfx::CharacterState state) const {
    return (reached_ >> static_cast<uint32_t>(state) & 1u) != 0;
  }
  float deepestOverlap() const { return overlap_; }  // m, of two characters, so far

 private:
  std::vector<pfx::Character> characters_;
  std::vector<pfx::CharacterInput> inputs_;
  std::vector<Outfit> outfits_;
  std::vector<Gait> gaits_;
  uint32_t reached_ = 0;  // bit k: state k
  float overlap_ = 0.0f;
};

// What a person asks with the keyboard, as the input of a character.
pfx::CharacterInput inputOf(const Controls& controls);

// Towards a point on the ground; shorter near it, so that nobody runs past.
pfx::Vec3 directionTo(const pfx::Vec3& from, const pfx::Vec3& to);

}  // namespace samples
