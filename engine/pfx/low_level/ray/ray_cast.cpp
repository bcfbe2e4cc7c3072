// Candidates from the broad phase, exact tests shape by shape.
#include "pfx/low_level/ray/ray_cast.h"

#include <algorithm>

#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/math/finite.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/low_level/broadphase/proxy.h"
#include "pfx/low_level/broadphase/shape_tree.h"
#include "pfx/low_level/continuous/time_of_impact.h"

namespace pfx {
namespace {

constexpr uint32_t kRayGrain = 16;

// Calls fraction = visit(body, fraction) for bodies that a box of this half extent may meet on its way.
template <class Visit>
void alongTheWay(const QueryScene& scene, const TreeRay& ray, Visit&& visit) {
  if (scene.tree != nullptr) {
    scene.tree->castRay(ray, visit);
    return;
  }
  float fraction = ray.max_fraction;
  for (uint32_t body = 0; body < scene.states.size(); ++body) fraction = visit(body, fraction);
}

struct Nearest {
  double fraction = 1.0;
  RayOutput output;
  ShapeHit hit;
  const Shape* shape = nullptr;
};

// Rounded up, so that shapes at the very same fraction are still asked, and never zero, which would end the search.
float upTo(double fraction) {
  return std::max(std::min(1.0f, static_cast<float>(fraction) * (1.0f + 0x1p-20f)), 1e-30f);
}

// Bodies without a collidable, or with a pose that is not finite, are not there.
bool isThere(const QueryScene& scene, uint32_t body) {
  return body < scene.states.size() && body < scene.collidables.size() && isFinite(scene.states[body].pose());
}

void castAtBody(const RayInput& ray, const QueryScene& scene, uint32_t body, Nearest& nearest) {
  if (!isThere(scene, body)) return;
  const RigidState& state = scene.states[body];
  if (!filtersMatch(ray.filter_self, ray.filter_target, state.filter_self, state.filter_target)) return;
  const auto shapes = scene.collidables[body].shapes();
  const auto tryShape = [&](uint32_t i) {
    if (isMissing(shapes[i].geometry)) return;
    LocalRay local = toLocal(ray, state.pose() * shapes[i].offset);
    local.max_fraction = nearest.fraction;
    const ShapeHit hit = castRay(local, shapes[i].geometry);
    if (!hit.hit) return;
    const RayOutput& o = nearest.output;
    const bool tie = o.hit && hit.fraction == nearest.fraction;
    if (tie && (body > o.body || (body == o.body && i >= o.shape))) return;
    nearest.fraction = hit.fraction;
    nearest.hit = hit;
    nearest.shape = &shapes[i];
    nearest.output.hit = true;
    nearest.output.body = body;
    nearest.output.shape = i;
  };
  const TreeRay way{ray.start, ray.direction, Vec3::Zero(), upTo(nearest.fraction)};
  visitShapesAlong(scene.collidables[body], toBody(way, state.pose()), [&](uint32_t i) {
    tryShape(i);
    return upTo(nearest.fraction);
  });
}

RayOutput finish(const RayInput& ray, const QueryScene& scene, const Nearest& nearest) {
  RayOutput o = nearest.output;
  if (!o.hit) return o;
  const Transform pose = scene.states[o.body].pose() * nearest.shape->offset;
  o.fraction = static_cast<float>(nearest.fraction);
  o.point = (ray.start.cast<double>() + nearest.fraction * ray.direction.cast<double>()).cast<float>();
  o.normal = pose.orientation * nearest.hit.normal;
  o.triangle = nearest.hit.triangle;
  o.barycentric = nearest.hit.barycentric;
  if (const auto* mesh = std::get_if<const LargeMesh*>(&nearest.shape->geometry)) {
    o.island = islandOf(**mesh, o.triangle);
    o.user_data = userData(**mesh, o.triangle);
  }
  return o;
}

}  // namespace

RayOutput castRay(const RayInput& ray, const QueryScene& scene) {
  if (!ray.start.allFinite() || !ray.direction.allFinite() || ray.direction.isZero(0.0f)) return {};
  Nearest nearest;
  alongTheWay(scene, {ray.start, ray.direction}, [&](uint32_t body, float) {
    castAtBody(ray, scene, body, nearest);
    return upTo(nearest.fraction);
  });
  return finish(ray, scene, nearest);
}

Error castRays(std::span<const RayInput> rays, const QueryScene& scene, std::span<RayOutput> outputs,
               TaskManager* tasks) {
  if (rays.size() != outputs.size()) return Error::OutOfRange;
  const auto cast = [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) outputs[i] = castRay(rays[i], scene);
  };
  const uint32_t n = static_cast<uint32_t>(rays.size());
  if (tasks != nullptr) {
    tasks->parallelFor(n, kRayGrain, cast);
  } else {
    cast({0, n, 0});
  }
  return Error::Ok;
}

ShapeCastOutput castShape(const ShapeCastInput& input, const QueryScene& scene) {
  ShapeCastOutput out;
  if (std::holds_alternative<const LargeMesh*>(input.geometry) || !input.motion.allFinite()) return out;
  if (isMissing(input.geometry) || !isFinite(input.start)) return out;
  const Shape shape{input.geometry, {}};
  const Sweep sweep{input.start, input.motion, Vec3::Zero()};
  const Aabb box = shapeAabb(input.geometry, input.start).grown(input.tolerance);
  const auto tryBody = [&](uint32_t body) {
    if (!isThere(scene, body)) return;
    const RigidState& state = scene.states[body];
    if (body == input.ignore_body || !(input.motion_types & motionTypeBit(state.motion_type))) return;
    if (!filtersMatch(input.filter_self, input.filter_target, state.filter_self, state.filter_target)) return;
    const Sweep still{state.pose(), Vec3::Zero(), Vec3::Zero()};
    const auto shapes = scene.collidables[body].shapes();
    const auto tryShape = [&](uint32_t i) {
      if (isMissing(shapes[i].geometry)) return;
      const Impact impact = timeOfImpact({shapes[i], still, shape, sweep, input.tolerance, out.fraction});
      if (!impact.touches()) return;
      const bool tie = out.hit && impact.fraction == out.fraction;
      if (tie && (body > out.body || (body == out.body && i >= out.shape))) return;
      out = {true, impact.state == Impact::State::Overlaps, impact.fraction, impact.point, impact.normal, body, i,
             impact.triangle};
    };
    const TreeRay way{box.center(), input.motion, box.halfExtent(), upTo(out.fraction)};
    visitShapesAlong(scene.collidables[body], toBody(way, state.pose()), [&](uint32_t i) {
      tryShape(i);
      return upTo(out.fraction);
    });
  };
  alongTheWay(scene, {box.center(), input.motion, box.halfExtent()}, [&](uint32_t body, float) {
    tryBody(body);
    return upTo(out.fraction);
  });
  return out;
}

void findOverlaps(const OverlapInput& input, const QueryScene& scene, std::vector<uint32_t>& bodies) {
  if (isMissing(input.geometry) || !isFinite(input.pose)) return;
  const Shape shape{input.geometry, {}};
  const Aabb box = shapeAabb(input.geometry, input.pose).grown(input.margin);
  const size_t first = bodies.size();
  MeshContactScratch scratch;
  Vector<ContactManifold> manifolds;
  const auto overlaps = [&](const Shape& other, const Transform& pose) {
    const CollideInput pair{other, pose, shape, input.pose, input.margin};
    if (other.type() == ShapeType::LargeMesh || shape.type() == ShapeType::LargeMesh) {
      manifolds.clear();
      return collideMesh(pair, scratch, manifolds) > 0;
    }
    ContactManifold m;
    return collideShapes(pair, m) > 0;
  };
  const auto tryBody = [&](uint32_t body) {
    if (!isThere(scene, body)) return;
    const RigidState& state = scene.states[body];
    if (!filtersMatch(input.filter_self, input.filter_target, state.filter_self, state.filter_target)) return;
    const Collidable& collidable = scene.collidables[body];
    const Transform in_body = relative(state.pose(), input.pose);
    bool found = false;
    visitShapes(collidable, shapeAabb(input.geometry, in_body).grown(input.margin), [&](uint32_t i) {
      const Shape& other = collidable.shapes()[i];
      found = found || (!isMissing(other.geometry) && overlaps(other, state.pose()));
    });
    if (found) bodies.push_back(body);
  };
  if (scene.tree != nullptr) {
    scene.tree->overlap(box, tryBody);
  } else {
    for (uint32_t body = 0; body < scene.states.size(); ++body) {
      if (isThere(scene, body) && bodyAabb(scene.states[body], scene.collidables[body]).overlaps(box)) tryBody(body);
    }
  }
  std::sort(bodies.begin() + static_cast<std::ptrdiff_t>(first), bodies.end());
}

}  // namespace pfx
