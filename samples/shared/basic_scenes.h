// The scenes that 1_simple, 2_stable and 3_sleep have in common; the samples differ only in what the world
// remembers.
#pragma once

#include <vector>

#include "samples/scene.h"

namespace samples {

// The basic scenes under the name of a sample and with its world settings.
std::vector<SceneEntry> basicScenes(std::string_view sample, const pfx::WorldDef& world);

}  // namespace samples
