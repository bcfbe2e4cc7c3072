// Sample 2_stable carries pairs, contacts and impulses from step to step.
#include "samples/registry.h"
#include "samples/shared/basic_scenes.h"

namespace samples {

std::vector<SceneEntry> stableScenes() { return basicScenes("2_stable", {.pipeline = pfx::Pipeline::Stable}); }

}  // namespace samples
