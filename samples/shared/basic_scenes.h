// The scenes that 1_simple, 2_stable and 3_sleep have in common; the samples differ only in what the world
// remembers.
#pragma once

#include <vector>

#include "samples/scene.h"

namespace samples {

// The basic scenes under the name of a sample and with its world settings.
std::vector<SceneEntry> basicScenes(std::string_view sample, const pfx::WorldDef& world);

// Their contents: one body of each kind of shape in the air, and the bowl of triangles that they land in.
void addPrimitives(pfx::World& world);
void addLandscape(pfx::World& world);

}  // namespace samples
