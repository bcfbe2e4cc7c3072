// Many rays against one large mesh.
#include "pfx/low_level/ray/cast_mesh_rays.h"

#include <algorithm>

namespace pfx {

void castMeshRays(std::span<const LocalRay> rays, const LargeMesh& mesh, std::span<ShapeHit> hits) {
  const size_t n = std::min(rays.size(), hits.size());
  for (size_t i = 0; i < n; ++i) hits[i] = castRay(rays[i], mesh);
}

}  // namespace pfx
