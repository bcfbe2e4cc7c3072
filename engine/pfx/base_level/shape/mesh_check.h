// Whether a mesh that came from outside, as out of a file, is safe to work with.
#pragma once

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// Whether all indices of the mesh point at something, its arrays fit together and its vertices are finite.
bool isConsistent(const ConvexMesh& mesh);
bool isConsistent(const LargeMesh& mesh);

}  // namespace pfx
