// The triangles that a large mesh was made of, for files.
#pragma once

#include <cstdint>
#include <vector>

#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace pfx {

struct LargeMeshSource {
  std::vector<Vec3> vertices;        // m
  std::vector<uint32_t> indices;     // three a triangle
  std::vector<float> thickness;      // m, by triangle
  std::vector<uint32_t> user_data;   // by triangle, or empty
  bool high_quality = false;         // the option that makes the same mesh again
};

// Triangles in their old order, without those that were dropped. A vertex that no triangle uses is at the origin of
// the mesh's bounds.
LargeMeshSource sourceOf(const LargeMesh& mesh);

}  // namespace pfx
