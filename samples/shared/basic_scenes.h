// The scenes that 1_simple and 2_stable have in common; the two samples differ only in what the world
// remembers.
#pragma once

#include <vector>

#include "samples/scene.h"

namespace samples {

// The basic scenes under the name of a sample and with its pipeline.
std::vector<SceneEntry> basicScenes(std::string_view sample, pfx::Pipeline pipeline);

}  // namespace samples
