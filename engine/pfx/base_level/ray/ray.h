// Rays: a start and a direction whose length is that of the ray. Nothing beyond the end is hit.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

// Which side of a surface a ray can hit. A solid is hit from inside only where its back faces count.
enum class FacetMode : uint8_t { FrontOnly, BackOnly, Both };

inline constexpr uint32_t kNoBody = 0xffffffffu;
inline constexpr uint32_t kNoTriangle = 0xffffffffu;

struct RayInput {
  Vec3 start = Vec3::Zero();       // m, world
  Vec3 direction = Vec3::Zero();   // m, end minus start
  uint32_t filter_self = 0xffffffffu;    // as for bodies: (ray.self & body.target) && (body.self & ray.target)
  uint32_t filter_target = 0xffffffffu;
  FacetMode facet_mode = FacetMode::FrontOnly;
};

struct RayOutput {
  bool hit = false;
  float fraction = 1.0f;                // of the direction, 0 .. 1
  Vec3 point = Vec3::Zero();            // m, world
  Vec3 normal = Vec3::Zero();           // unit, world, against the ray
  uint32_t body = kNoBody;
  uint32_t shape = 0;                   // in the collidable of the body
  uint32_t island = kNoTriangle;        // large meshes: island ...
  uint32_t triangle = kNoTriangle;      // ... and facet (index in the mesh); convex meshes: face
  uint32_t user_data = 0;               // of the facet
  Vec2 barycentric = Vec2::Zero();      // large meshes: (s, t), point = v0 + s (v1 - v0) + t (v2 - v0)
};

// A ray in the frame of one shape, in double precision: a ray from far away loses nothing on its way into the frame.
struct LocalRay {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();      // m
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // m
  double max_fraction = 1.0;                            // hits beyond it do not count
  FacetMode facet_mode = FacetMode::FrontOnly;
};

struct ShapeHit {
  bool hit = false;
  double fraction = 1.0;
  Vec3 normal = Vec3::Zero();  // unit, shape frame, against the ray
  uint32_t triangle = kNoTriangle;
  Vec2 barycentric = Vec2::Zero();
};

// The ray seen from the frame of `pose`.
LocalRay toLocal(const RayInput& ray, const Transform& pose);

// Nearest hit on one shape. Sizes must be valid (Collidable::finish); a ray without direction hits nothing.
ShapeHit castRay(const LocalRay& ray, const Sphere& sphere);
ShapeHit castRay(const LocalRay& ray, const Box& box);
ShapeHit castRay(const LocalRay& ray, const Capsule& capsule);
ShapeHit castRay(const LocalRay& ray, const Cylinder& cylinder);
ShapeHit castRay(const LocalRay& ray, const ConvexMesh& mesh);
ShapeHit castRay(const LocalRay& ray, const LargeMesh& mesh);
ShapeHit castRay(const LocalRay& ray, const Geometry& geometry);

// hits[i] = castRay(rays[i], mesh), bit for bit, sooner than one by one: the rays of a batch hide each other's waits for
// memory. Spans of the same length.
void castRays(std::span<const LocalRay> rays, const LargeMesh& mesh, std::span<ShapeHit> hits);

}  // namespace pfx
