// Broad-phase proxies: what pair finding needs to know of a body, one dense record each.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/error.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct BroadphaseProxy {
  Aabb bounds;        // m, world
  uint32_t body = 0;  // index of the body
  uint32_t filter_self = 0xffffffffu;
  uint32_t filter_target = 0xffffffffu;
  MotionType motion_type = MotionType::Active;
};

// True when the motion types and the contact filters of two bodies let them form a pair. Symmetric.
inline bool mayPair(const BroadphaseProxy& a, const BroadphaseProxy& b) {
  return detectsCollision(a.motion_type, b.motion_type) &&
         filtersMatch(a.filter_self, a.filter_target, b.filter_self, b.filter_target);
}

// The box in which the scene takes place. Coordinates lose precision with distance from the origin, so a
// world should be no larger than it has to be: at 500 m a float resolves 30 micrometres, at 50 km 4 mm.
struct WorldBox {
  Vec3 center = Vec3::Zero();            // m
  Vec3 extent = Vec3::Constant(500.0f);  // m, half the size

  bool meets(const Aabb& box) const { return Aabb{center - extent, center + extent}.overlaps(box); }
};

// What becomes of a body that has left the world. Flags.
enum class OutOfWorld : uint8_t {
  Keep = 0,         // nothing: it is reported, and goes on as before
  FixMotion = 1,    // it becomes Fixed, with zero velocity
  RemoveProxy = 2,  // it gets no proxy and so meets nobody
  FixAndRemove = 3,
};

// Bounds of a body in the world (m).
Aabb bodyAabb(const RigidState& state, const Collidable& collidable);

// Writes the proxy of one body, with bounds grown by `margin` (m). Error::OutOfWorld when the bounds do not
// meet the world, or are not finite; the proxy is written all the same.
Error updateProxy(const RigidState& state, const Collidable& collidable, const WorldBox& world, float margin,
                  BroadphaseProxy& proxy);

struct UpdateProxiesParams {
  WorldBox world = {};
  float margin = 0.0f;  // m, added on every side
  OutOfWorld out_of_world = OutOfWorld::Keep;
};

struct UpdateProxiesResult {
  Error error = Error::Ok;   // OutOfRange: spans of different length; OutOfWorld: num_outside > 0
  uint32_t num_proxies = 0;  // written to the front of the span, in the order of the bodies
  uint32_t num_outside = 0;  // bodies that have left the world
};

// Writes a proxy for each body (states[i], collidables[i] -> proxies[i], with body index i), and deals with
// bodies that have left the world. The spans have the same length.
UpdateProxiesResult updateProxies(std::span<RigidState> states, std::span<const Collidable> collidables,
                                  const UpdateProxiesParams& params, std::span<BroadphaseProxy> proxies,
                                  TaskManager* tasks = nullptr);

// The axis (0, 1, 2) along which the centres of the bounds vary most: the one to sweep along. Any axis gives
// the same pairs.
int axisOfLargestVariance(std::span<const BroadphaseProxy> proxies);

}  // namespace pfx
