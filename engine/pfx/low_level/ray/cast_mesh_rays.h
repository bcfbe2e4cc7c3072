// Many rays against one large mesh.
#pragma once

#include <span>

#include "pfx/base_level/ray/ray.h"

namespace pfx {

// hits[i] is what castRay(rays[i], mesh) gives, bit for bit. Both spans have the same length.
void castMeshRays(std::span<const LocalRay> rays, const LargeMesh& mesh, std::span<ShapeHit> hits);

}  // namespace pfx
