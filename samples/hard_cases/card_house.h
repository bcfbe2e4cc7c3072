// Houses of cards: five storeys of cards of 40 x 20 cm that lean by 25 degrees; 30 lean, 10 lie.
#pragma once

#include "pfx/high_level/world/world.h"

namespace samples::hard_cases {

struct CardHouse {
  float x = 0.0f;                  // m, of its middle
  float friction = 0.6f;           // of the cards and the slab under them; it takes tan(25 deg) / 2 = 0.233
  float half_thickness = 0.001f;   // m, of a card
  float rolling_resistance = 0.0f;  // m
};

// On y = 0, in the plane z = 0. Returns the index of a topmost card.
uint32_t addCardHouse(pfx::World& world, const CardHouse& house);

}  // namespace samples::hard_cases
