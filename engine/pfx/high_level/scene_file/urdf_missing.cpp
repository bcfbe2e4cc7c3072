// In place of urdf_reader.cpp where liburdfdom was not there when the engine was built.
#include "pfx/high_level/scene_file/urdf_reader.h"

namespace pfx {

bool canReadUrdf() { return false; }

SceneDef readUrdf(const std::filesystem::path& path, const UrdfOptions& options) {
  return readUrdf(SceneText{.xml = {}, .name = path.string()}, options);
}

SceneDef readUrdf(const SceneText& text, const UrdfOptions&) {
  throw SceneError(text.name + ": this program was built without liburdfdom (package liburdfdom-dev) and reads no URDF files");
}

}  // namespace pfx
