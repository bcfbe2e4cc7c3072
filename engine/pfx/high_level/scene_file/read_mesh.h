// Meshes of a scene file.
#pragma once

#include <filesystem>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/high_level/scene_file/xml_element.h"

namespace pfx {

// The id was read by the caller. Vertices and triangles stand in the element, or in an OBJ file below `folder`.
// Throw SceneError.
ConvexMesh readConvexMesh(XmlElement& element, const std::filesystem::path& folder);
LargeMesh readLargeMesh(XmlElement& element, const std::filesystem::path& folder);

}  // namespace pfx
