// Proxies from states and collidables.
#include "pfx/low_level/broadphase/proxy.h"

#include <atomic>

namespace pfx {

namespace {

constexpr uint32_t kGrain = 256;

bool has(OutOfWorld value, OutOfWorld flag) {
  return (static_cast<uint8_t>(value) & static_cast<uint8_t>(flag)) != 0;
}

void stop(RigidState& state) {
  state.motion_type = MotionType::Fixed;
  state.linear_velocity = state.angular_velocity = Vec3::Zero();
}

uint32_t removeOutside(const WorldBox& world, std::span<BroadphaseProxy> proxies) {
  uint32_t kept = 0;
  for (const BroadphaseProxy& proxy : proxies) {
    if (world.meets(proxy.bounds)) proxies[kept++] = proxy;
  }
  return kept;
}

}  // namespace

Aabb bodyAabb(const RigidState& state, const Collidable& collidable) {
  // Tight bounds of a primitive cost little; a turned box round a sphere is not tight. A collidable that was
  // not finished has no extent, whatever its shape.
  const Shape& shape = collidable.inline_shape;
  const bool is_primitive = shape.geometry.index() <= static_cast<std::size_t>(ShapeType::Cylinder);
  if (collidable.external.empty() && is_primitive && !collidable.half_extent.isZero(0.0f)) {
    return shapeAabb(shape.geometry, state.pose() * shape.offset);
  }
  return transformedAabb(state.pose(), collidable.center, collidable.half_extent);
}

Error updateProxy(const RigidState& state, const Collidable& collidable, const WorldBox& world, float margin,
                  BroadphaseProxy& proxy) {
  proxy.bounds = bodyAabb(state, collidable).grown(margin);
  proxy.body = state.body_id;
  proxy.filter_self = state.filter_self;
  proxy.filter_target = state.filter_target;
  proxy.motion_type = state.motion_type;
  return world.meets(proxy.bounds) ? Error::Ok : Error::OutOfWorld;
}

UpdateProxiesResult updateProxies(std::span<RigidState> states, std::span<const Collidable> collidables,
                                  const UpdateProxiesParams& params, std::span<BroadphaseProxy> proxies,
                                  TaskManager* tasks) {
  if (collidables.size() != states.size() || proxies.size() != states.size())
    return {.error = Error::OutOfRange};
  const uint32_t n = static_cast<uint32_t>(states.size());
  std::atomic<uint32_t> num_outside{0};
  parallelFor(tasks, n, kGrain, [&](TaskRange range) {
    uint32_t outside = 0;
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const Error error = updateProxy(states[i], collidables[i], params.world, params.margin, proxies[i]);
      proxies[i].body = i;
      if (error != Error::OutOfWorld) continue;
      ++outside;
      if (has(params.out_of_world, OutOfWorld::FixMotion)) {
        stop(states[i]);
        proxies[i].motion_type = MotionType::Fixed;
      }
    }
    if (outside > 0) num_outside.fetch_add(outside, std::memory_order_relaxed);
  });

  const bool remove = num_outside > 0 && has(params.out_of_world, OutOfWorld::RemoveProxy);
  return {.error = num_outside > 0 ? Error::OutOfWorld : Error::Ok,
          .num_proxies = remove ? removeOutside(params.world, proxies) : n,
          .num_outside = num_outside};
}

int axisOfLargestVariance(std::span<const BroadphaseProxy> proxies) {
  Eigen::Array3d sum = Eigen::Array3d::Zero(), sum_of_squares = Eigen::Array3d::Zero();
  for (const BroadphaseProxy& proxy : proxies) {
    const Eigen::Array3d c = proxy.bounds.center().cast<double>().array();
    sum += c;
    sum_of_squares += c * c;
  }
  // n times the variance; the largest stays the largest.
  const Eigen::Array3d spread =
      sum_of_squares - sum * sum / std::max<double>(1.0, static_cast<double>(proxies.size()));
  int axis = 0;
  if (spread[1] > spread[axis]) axis = 1;
  if (spread[2] > spread[axis]) axis = 2;
  return axis;
}

}  // namespace pfx
