// Triangles from Wavefront OBJ files: vertices and faces; everything else in the file is skipped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct TriangleList {
  std::vector<Vec3> vertices;      // m
  std::vector<uint32_t> indices;   // three a triangle
};

// Reads `text`; polygons become fans. `name` stands for the file in messages. Throws SceneError "NAME:LINE: cause".
TriangleList readObj(std::string_view text, const std::string& name);

// A whole file. Throws SceneError.
std::string readTextFile(const std::filesystem::path& path);

}  // namespace pfx
