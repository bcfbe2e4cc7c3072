// Queries over many bodies: rays, swept shapes, overlaps.
//
// All are const: any number of threads may ask at once while nothing changes the scene.
#pragma once

#include <span>
#include <vector>

#include "pfx/base_level/ray/ray.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/low_level/broadphase/tree_broadphase.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct QueryScene {
  std::span<const RigidState> states;       // by body
  std::span<const Collidable> collidables;  // by body; one that has no finished shape is not hit, nor one with a pose that is not finite
  // Finds candidates; without it every body is looked at. The bounds in it must hold the bodies where they are now.
  const TreeBroadphase* tree = nullptr;
};

// Nearest hit; among equals the lowest body, then shape. A ray without length or with a value that is not finite hits
// nothing.
RayOutput castRay(const RayInput& ray, const QueryScene& scene);

// outputs[i] = castRay(rays[i], scene), shared out over `tasks` if given. Error::OutOfRange for spans of different
// length; nothing is done then.
Error castRays(std::span<const RayInput> rays, const QueryScene& scene, std::span<RayOutput> outputs,
               TaskManager* tasks = nullptr);

// A convex shape that is moved without turning.
struct ShapeCastInput {
  const Geometry& geometry;
  Transform start;               // shape to world
  Vec3 motion = Vec3::Zero();    // m
  uint32_t filter_self = 0xffffffffu;
  uint32_t filter_target = 0xffffffffu;
  float tolerance = 1e-4f;       // m, how near counts as touching
  uint32_t ignore_body = kNoBody;  // is passed, such as the body that asks
  uint8_t motion_types = 0xffu;    // bodies of these types count: bit k for motion type k
};

// The bit of a motion type in ShapeCastInput::motion_types.
constexpr uint8_t motionTypeBit(MotionType t) { return static_cast<uint8_t>(1u << static_cast<uint8_t>(t)); }

struct ShapeCastOutput {
  bool hit = false;
  bool overlaps = false;                // touched something at the start; fraction is 0
  float fraction = 1.0f;
  Vec3 point = Vec3::Zero();            // m, world, on the body that is hit
  Vec3 normal = Vec3::Zero();           // unit, world, from that body to the shape; zero if they overlap deeply
  uint32_t body = kNoBody;
  uint32_t shape = 0;
  uint32_t triangle = kNoTriangle;      // facet of a large mesh
};

// First touch on the way; among equals the lowest body, then shape. A large mesh cannot be cast.
ShapeCastOutput castShape(const ShapeCastInput& input, const QueryScene& scene);

struct OverlapInput {
  const Geometry& geometry;
  Transform pose;        // shape to world
  uint32_t filter_self = 0xffffffffu;
  uint32_t filter_target = 0xffffffffu;
  float margin = 0.0f;   // m, >= 0; bodies this near count
};

// Appends the bodies that overlap the convex shape, ascending.
void findOverlaps(const OverlapInput& input, const QueryScene& scene, std::vector<uint32_t>& bodies);

}  // namespace pfx
