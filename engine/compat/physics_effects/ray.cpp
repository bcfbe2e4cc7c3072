#include "compat/physics_effects/ray.h"

#include <algorithm>
#include <cmath>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/ray/ray.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace sce::PhysicsEffects {
namespace {

PfxSubData subData(const PfxShape& shape, const pfx::ShapeHit& hit) {
  PfxSubData sub;
  const PfxLargeTriMesh* mesh = shape.getLargeTriMesh();
  if (mesh == nullptr || hit.triangle == pfx::kNoTriangle) return sub;
  const uint32_t island = pfx::islandOf(*mesh->m_native, hit.triangle);
  sub.m_type = PfxSubData::MESH_INFO;
  sub.setIslandId(static_cast<PfxUInt16>(island));
  sub.setFacetId(static_cast<PfxUInt16>(hit.triangle - mesh->m_native->islands[island].first_facet));
  sub.setUserData(pfx::userData(*mesh->m_native, hit.triangle));
  sub.setFacetLocalS(hit.barycentric.x());
  sub.setFacetLocalT(hit.barycentric.y());
  return sub;
}

// Whether the part of the ray up to `fraction` meets the box.
bool meets(const pfx::RayInput& ray, const pfx::Aabb& box, double fraction) {
  double enter = 0.0, leave = fraction;
  for (int k = 0; k < 3; ++k) {
    const double start = ray.start[k], way = ray.direction[k];
    if (way == 0.0) {
      if (start < box.min[k] || start > box.max[k]) return false;
      continue;
    }
    const double s = (box.min[k] - start) / way, t = (box.max[k] - start) / way;
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter <= leave;
}

// Nearest hit so far.
struct Best {
  double fraction = 1.0;
  bool hit = false;
};

void castAtBody(const pfx::RayInput& ray, PfxUInt16 id, const PfxRayCastParam& p, Best& best, PfxRayOutput& out) {
  const PfxRigidState& state = p.offsetRigidStates[id];
  const PfxCollidable& collidable = p.offsetCollidables[id];
  const pfx::Aabb box = bodyAabb(state, collidable);
  if (!meets(ray, box.grown(1e-4f * (1.0f + box.halfExtent().maxCoeff())), best.fraction)) return;
  for (PfxUInt32 i = 0; i < collidable.getNumShapes(); ++i) {
    const PfxShape& shape = collidable.getShape(i);
    if (!isValid(shape)) continue;
    const pfx::Shape s = native(shape);
    const pfx::Transform pose = poseOf(state) * s.offset;
    pfx::LocalRay local = pfx::toLocal(ray, pose);
    local.max_fraction = best.fraction;
    const pfx::ShapeHit hit = pfx::castRay(local, s.geometry);
    const bool nearer = hit.fraction < best.fraction || !best.hit || (hit.fraction == best.fraction && id < out.m_rigidBodyId);
    if (!hit.hit || !nearer) continue;
    best = {hit.fraction, true};
    out.m_contactFlag = true;
    out.m_variable = static_cast<PfxFloat>(hit.fraction);
    out.m_contactPoint = compat(pfx::Vec3(ray.start + out.m_variable * ray.direction));
    out.m_contactNormal = compat(pfx::Vec3(pose.orientation * hit.normal));
    out.m_rigidBodyId = id;
    out.m_shapeId = static_cast<PfxUInt8>(i);
    out.m_subData = subData(shape, hit);
  }
}

// The array that is sorted along the axis on which the ray covers most ground, from the end where it starts; any other
// that is there will do.
struct Order {
  const PfxBroadphaseProxy* proxies = nullptr;
  int axis = 0;
  bool from_upper_end = false;
};
Order orderFor(const pfx::Vec3& direction, const PfxRayCastParam& p) {
  const PfxBroadphaseProxy* const arrays[] = {p.proxiesX, p.proxiesY, p.proxiesZ, p.proxiesXb, p.proxiesYb, p.proxiesZb};
  int axis;
  direction.cwiseAbs().maxCoeff(&axis);
  const bool down = direction[axis] < 0.0f;
  if (const PfxBroadphaseProxy* best = arrays[down ? axis + 3 : axis]; best != nullptr) return {best, axis, down};
  for (int k = 0; k < 6; ++k)
    if (arrays[k] != nullptr) return {arrays[k], k % 3, k >= 3};
  return {};
}

// Where the nearer end of a proxy lies along the axis, m, a cell of rounding allowed for.
double nearEnd(const PfxBroadphaseProxy& proxy, const Order& order, const PfxRayCastParam& p) {
  const PfxUInt32 cell = order.from_upper_end ? pfxGetXYZMax(proxy, order.axis) : pfxGetXYZMin(proxy, order.axis);
  const double size = 2.0 * p.rangeExtent[order.axis] / SCE_PFX_PROXY_GRID_MAX_;
  const double at = double(p.rangeCenter[order.axis]) - p.rangeExtent[order.axis] + cell * size;
  return order.from_upper_end ? at + size : at - size;
}

}  // namespace

void pfxCastSingleRay(const PfxRayInput& input, PfxRayOutput& out, const PfxRayCastParam& p) {
  out = PfxRayOutput();
  const pfx::RayInput ray{native(input.m_startPosition), native(input.m_direction), input.m_contactFilterSelf,
                          input.m_contactFilterTarget,
                          static_cast<pfx::FacetMode>(SCE_PFX_MIN(input.m_facetMode, SCE_PFX_RAY_FACET_MODE_FRONT_AND_BACK))};
  if (p.offsetRigidStates == nullptr || p.offsetCollidables == nullptr) return;
  if (!ray.start.allFinite() || !ray.direction.allFinite() || ray.direction.isZero(0.0f)) return;
  const Order order = orderFor(ray.direction, p);
  if (order.proxies == nullptr) return;

  Best best;
  for (PfxUInt32 i = 0; i < p.numProxies; ++i) {
    const PfxBroadphaseProxy& proxy = order.proxies[i];
    const double start = ray.start[order.axis], end = start + best.fraction * ray.direction[order.axis];
    const double near_end = nearEnd(proxy, order, p);
    // Bodies outside of the world lie on its border in the grid, so only the border itself is searched to the end.
    const bool on_border = order.from_upper_end ? pfxGetXYZMax(proxy, order.axis) == 0
                                                : pfxGetXYZMin(proxy, order.axis) == SCE_PFX_PROXY_GRID_MAX_;
    const bool beyond = order.from_upper_end ? near_end < std::min(start, end) : near_end > std::max(start, end);
    if (beyond && !on_border) continue;
    if (!pfx::filtersMatch(ray.filter_self, ray.filter_target, pfxGetSelf(proxy), pfxGetTarget(proxy))) continue;
    castAtBody(ray, pfxGetRigidBodyId(proxy), p, best, out);
  }
}

void pfxCastRays(const PfxRayInput* inputs, PfxRayOutput* outputs, int numRays, const PfxRayCastParam& param,
                 PfxTaskManager* taskManager) {
  if (inputs == nullptr || outputs == nullptr || numRays <= 0) return;
  pfx::parallelFor(poolOf(taskManager), static_cast<uint32_t>(numRays), 16, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) pfxCastSingleRay(inputs[i], outputs[i], param);
  });
}

}  // namespace sce::PhysicsEffects
