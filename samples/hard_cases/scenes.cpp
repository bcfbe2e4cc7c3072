// The hard stability cases as scenes, each with the figures that decide whether it holds.
#include "samples/hard_cases/witness.h"
#include "samples/registry.h"

namespace samples {

std::vector<SceneEntry> hardCaseScenes() {
  std::vector<SceneEntry> all;
  for (const auto family : {hard_cases::stackScenes, hard_cases::structureScenes, hard_cases::machineScenes})
    for (SceneEntry& entry : family()) all.push_back(std::move(entry));
  return all;
}

}  // namespace samples
