#include "pfx/base_level/collision/mesh_seam.h"

#include <algorithm>

#include "pfx/base_level/collision/mesh_normals.h"
#include "pfx/base_level/shape/mesh_query.h"

namespace pfx {
namespace {

constexpr float kNear = 1e-3f;          // of the size of a facet
constexpr float kSameNormal = 0.9999f;  // within a degree: manifolds gather normals that close

void judgeFacet(const MeshTriangle& t, const SurfacePoint& at, SeamVerdict& verdict) {
  const float size = (t.vertex[1] - t.vertex[0]).norm() + (t.vertex[2] - t.vertex[0]).norm();
  const float near = kNear * size + at.slack;
  if (std::abs(t.normal.dot(at.point - t.vertex[0])) > near) return;
  float rise = 0.0f;
  for (int k = 0; k < 3; ++k) {
    if (edgeOutward(t, k).dot(at.point - t.vertex[k]) > near) return;
    const Vec3 d = t.vertex[k] - at.point;
    rise = std::max(rise, at.normal.dot(d) - 2.0f * kLeanTolerance * d.norm());
  }
  if (t.normal.dot(at.normal) > kSameNormal) verdict.is_facet_normal = true;
  if (rise > near) verdict.is_covered = true;
}

}  // namespace

void judge(const LargeMesh& mesh, const SurfacePoint& at, SeamVerdict& verdict) {
  // Rounding of positions, and the grid of a quantized mesh.
  SurfacePoint here = at;
  here.slack += 4e-7f * at.point.cwiseAbs().maxCoeff() + 2.0f * mesh.grid_scale.maxCoeff();
  const float reach = kNear * mesh.surface_bounds.halfExtent().norm() + here.slack;
  visitFacets(mesh, Aabb{here.point, here.point}.grown(reach), [&](uint32_t first, uint32_t count) {
    for (uint32_t f = first; f < first + count; ++f) judgeFacet(meshTriangle(mesh, f), here, verdict);
  });
}

}  // namespace pfx
