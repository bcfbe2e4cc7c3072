// How a character is drawn: a coloured capsule with visor, shoes and hands that keep step, and its state
// above.
#pragma once

#include "pfx/high_level/character/character.h"
#include "samples/canvas.h"

namespace samples {

struct Outfit {
  pfx::Color coat = 0xff3f7f93u, trim = 0xff27323bu;
};

// What of a character's looks goes on from step to step.
struct Gait {
  float stride = 0.0f;  // rad, of the swing of the legs

  void advance(const pfx::Character& character, const pfx::World& world, float dt);
};

struct Actor {
  const pfx::Character& character;
  const Gait& gait;
  Outfit outfit = {};
  bool labelled = true;
};

void drawActor(const Actor& actor, const pfx::World& world, Canvas& canvas);

}  // namespace samples
