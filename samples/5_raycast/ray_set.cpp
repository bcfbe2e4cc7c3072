#include "samples/5_raycast/ray_set.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace samples {
namespace {

using namespace pfx;

constexpr Stroke kHitRay{0xff2f6f8fu, 1.2f}, kMissedRay{0x50808890u, 1.0f};
constexpr Stroke kHitPoint{0xffd8402fu, 6.0f}, kHitNormal{0xffd8402fu, 2.0f}, kHitTriangle{0xffe09020u, 2.0f};
constexpr float kNormalLength = 0.8f;  // m
constexpr float kLift = 0.02f;         // m, of an outline over its surface

void outlineTriangle(const World& world, const RayOutput& hit, Canvas& canvas) {
  const Shape& shape = world.collidables()[hit.body].shapes()[hit.shape];
  const auto* mesh = std::get_if<const LargeMesh*>(&shape.geometry);
  if (mesh == nullptr) return;
  const Transform pose = world.states()[hit.body].pose() * shape.offset;
  const auto v = facetVertices(**mesh, hit.triangle);
  const Vec3 lift = kLift * hit.normal;
  for (int k = 0; k < 3; ++k) canvas.line(pose.apply(v[k]) + lift, pose.apply(v[(k + 1) % 3]) + lift, kHitTriangle);
}

// A ball of a tenth of a millimetre at the hit, against the shape: its gap and its radius make the distance.
double distanceFromSurface(const World& world, const RayOutput& hit) {
  constexpr float kProbe = 1e-4f, kReach = 0.1f;  // m
  const Shape probe{Sphere{kProbe}, {}}, &shape = world.collidables()[hit.body].shapes()[hit.shape];
  const Transform at{.position = hit.point}, body = world.states()[hit.body].pose();
  const CollideInput input{shape, body, probe, at, kReach};
  Vector<ContactManifold> found(1);
  if (shape.type() == ShapeType::LargeMesh) {
    found.clear();
    MeshContactScratch scratch;
    collideMesh(input, scratch, found);
  } else {
    collideShapes(input, found[0]);
  }
  double nearest = kReach;
  for (const ContactManifold& m : found)
    for (int i = 0; i < m.num_points; ++i)
      nearest = std::min(nearest, std::abs(static_cast<double>(m.points[i].distance) + kProbe));
  return nearest;
}

}  // namespace

int RaySet::numHits() const { return static_cast<int>(std::ranges::count_if(hits, &RayOutput::hit)); }

RaySet castAt(const World& world, std::vector<RayInput> rays) {
  RaySet set{std::move(rays), {}};
  set.hits.resize(set.rays.size());
  world.castRays(set.rays, set.hits);
  return set;
}

std::vector<RayInput> ringOfRays(const Ring& ring) {
  std::vector<RayInput> rays;
  for (int i = 0; i < ring.count; ++i) {
    const float angle = ring.angle + 2.0f * kPi * static_cast<float>(i) / static_cast<float>(ring.count);
    const Vec3 outward(cos(angle), 0.0f, sin(angle));
    RayInput ray;
    ray.start = ring.radius * outward + Vec3(0.0f, ring.height, 0.0f);
    // Neighbours end at different depths of the scene, so that together they scan it.
    const float reach = ring.end_radius * (1.0f - 0.4f * static_cast<float>(i % 5));
    ray.direction = reach * outward - Vec3(0.0f, ring.depth, 0.0f) - ray.start;
    rays.push_back(ray);
  }
  return rays;
}

void draw(const RaySet& set, const World& world, Canvas& canvas) {
  for (size_t i = 0; i < set.rays.size(); ++i) {
    const RayInput& ray = set.rays[i];
    const RayOutput& hit = set.hits[i];
    const Vec3 end = hit.hit ? hit.point : Vec3(ray.start + ray.direction);
    canvas.line(ray.start, end, hit.hit ? kHitRay : kMissedRay);
    if (!hit.hit) continue;
    outlineTriangle(world, hit, canvas);
    canvas.point(hit.point, kHitPoint);
    canvas.arrow(hit.point, hit.point + kNormalLength * hit.normal, kHitNormal);
  }
}

double farthestFromSurface(const RaySet& set, const World& world) {
  double farthest = 0.0;
  for (const RayOutput& hit : set.hits)
    if (hit.hit) farthest = std::max(farthest, distanceFromSurface(world, hit));
  return farthest;
}

}  // namespace samples
