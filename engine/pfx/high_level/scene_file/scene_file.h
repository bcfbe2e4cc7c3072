// Scenes as XML files: everything that a world can be given, read and written.
//
// samples/11_xml_import/scene.xsd lists the elements, example.xml explains them. Floats are written so that reading
// gives the same bits. What the solver remembers (contacts, sleep) is not part of a scene; a snapshot has it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pfx/high_level/scene_file/scene_def.h"

namespace pfx {

// "FILE:LINE: <ELEMENT>: cause"
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reads a scene. Meshes in OBJ files are looked for next to it. Throws SceneError; unknown elements and attributes are
// errors that name the nearest known one.
SceneDef readScene(const std::filesystem::path& path);

// The same of a text in memory. `name` stands for the file in messages; OBJ files are looked for in `folder`.
struct SceneText {
  std::string_view xml;
  std::string name = "scene";
  std::filesystem::path folder = {};
};
SceneDef readScene(const SceneText& text);

// Replaces `world` by the scene of a file; it keeps its number of workers and its SIMD level. Throws SceneError, and
// leaves the world as it is then.
void loadScene(const std::filesystem::path& path, World& world);
void loadScene(const SceneText& text, World& world);

// The world as a scene, in the order of its bodies. Removed bodies are left out.
std::string writeScene(const World& world);

// Writes it to a file. Throws SceneError when that fails.
void saveScene(const std::filesystem::path& path, const World& world);

}  // namespace pfx
