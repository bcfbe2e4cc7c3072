#include "samples/registry.h"

#include <array>

namespace samples {
namespace {

// In the order of the browser.
constexpr std::array kSamples = {
    simpleScenes,
    stableScenes,
    sleepScenes,
    motionTypeScenes,
    raycastScenes,
    jointScenes,
    serializeScenes,
    deformMeshScenes,
    particlePhysicsScenes,
    characterScenes,
    xmlImportScenes,
    tutorialScenes,
    accuracyScenes,
    hardCaseScenes,
    benchmarkScenes,
};

std::vector<SceneEntry> allScenes() {
  std::vector<SceneEntry> all;
  for (const auto sample : kSamples)
    for (SceneEntry& entry : sample()) all.push_back(std::move(entry));
  return all;
}

}  // namespace

std::span<const SceneEntry> scenes() {
  static const std::vector<SceneEntry> table = allScenes();
  return table;
}

std::vector<const SceneEntry*> findScenes(std::string_view target) {
  const auto slash = target.find('/');
  const std::string_view sample = target.substr(0, slash);
  std::vector<const SceneEntry*> found;
  for (const SceneEntry& e : scenes())
    if (e.sample == sample && (slash == target.npos || e.name == target.substr(slash + 1)))
      found.push_back(&e);
  return found;
}

}  // namespace samples
