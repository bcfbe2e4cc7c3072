// Which stages a world can enter with what it holds, found without a step.
#pragma once

#include <string_view>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace pfx {

// The stages that steps of the world may enter as long as nothing is added to it, in order. World::stages() tells
// which of them it has entered. Costs a look at each body. Callbacks that change contacts are not asked about.
std::vector<std::string_view> possibleStages(const World& world);

}  // namespace pfx
