// A scene that can be run, wherever it comes from: the sample table or a file.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/scene.h"

namespace viewer {

struct SceneSpec {
  std::string sample;  // "2_stable"; of a file: its stem
  std::string name;    // "tower"
  std::string shows;   // one line
  samples::CameraPose camera;
  std::vector<int> frames;  // to be photographed
  pfx::WorldDef world;
  std::function<std::unique_ptr<samples::Scene>()> make;

  std::string target() const { return sample + "/" + name; }
};

// All sample scenes, in the order of the browser.
std::vector<SceneSpec> allScenes();

// The scenes of `scenes` that TARGET names: SAMPLE or SAMPLE/SCENE; or the scene of an .xml file or a snapshot. Throws InputError
// naming the nearest known target, or the line of the file.
std::vector<SceneSpec> findTarget(std::span<const SceneSpec> scenes, std::string_view target);

// The one scene that TARGET names: SAMPLE/SCENE, or the SAMPLE of a single scene. Throws InputError when
// there are more.
SceneSpec findScene(std::span<const SceneSpec> scenes, std::string_view target);

}  // namespace viewer
