// Sample 1_simple keeps nothing from step to step: pairs and contacts are made anew.
#include "samples/registry.h"
#include "samples/shared/basic_scenes.h"

namespace samples {

std::vector<SceneEntry> simpleScenes() { return basicScenes("1_simple", {.pipeline = pfx::Pipeline::Simple}); }

}  // namespace samples
