// Which solver takes the contacts of an island.
#pragma once

#include <cstdint>

namespace pfx {

enum class ContactSolver : uint8_t {
  Auto,    // Newton for small islands whose contacts carry many times the weight of their bodies
  Soft,    // soft_step.h for all
  Newton,  // newton_island.h for every island that it can take
};

}  // namespace pfx
