// The table of all scenes, one line a scene, in the order of the browser.
#include "samples/scene.h"

namespace samples {

std::span<const SceneEntry> scenes() {
  static const std::vector<SceneEntry> table;
  return table;
}

std::vector<const SceneEntry*> findScenes(std::string_view target) {
  const auto slash = target.find('/');
  const std::string_view sample = target.substr(0, slash);
  std::vector<const SceneEntry*> found;
  for (const SceneEntry& e : scenes())
    if (e.sample == sample && (slash == target.npos || e.name == target.substr(slash + 1))) found.push_back(&e);
  return found;
}

}  // namespace samples
