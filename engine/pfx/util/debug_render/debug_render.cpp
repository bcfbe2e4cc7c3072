// Immediate drawing of boxes, axes, islands and contacts.
#include "pfx/util/debug_render/debug_render.h"

#include <algorithm>

#include "pfx/low_level/broadphase/proxy.h"
#include "pfx/util/debug_render/palette.h"

namespace pfx {

void DebugRender::resetVisible(uint32_t count) { hidden_.assign(count, false); }

void DebugRender::setVisible(uint32_t body, bool visible) {
  if (body >= hidden_.size()) hidden_.resize(body + std::size_t{1}, false);
  hidden_[body] = !visible;
}

void DebugRender::renderWorld(const Vec3& center, const Vec3& extent) {
  if (callbacks.aabb != nullptr) callbacks.aabb(callbacks.context, center, extent, kWorldColor);
}

void DebugRender::renderAabb(std::span<const RigidState> states, std::span<const Collidable> collidables) {
  if (callbacks.aabb == nullptr) return;
  for (uint32_t i = 0; i < std::min(states.size(), collidables.size()); ++i) {
    if (!getVisible(i)) continue;
    const Aabb box = bodyAabb(states[i], collidables[i]);
    callbacks.aabb(callbacks.context, box.center(), box.halfExtent(),
                   bodyLook(states[i], i).color | 0xff000000u);
  }
}

void DebugRender::renderLocalAxis(std::span<const RigidState> states) {
  if (callbacks.line == nullptr) return;
  for (uint32_t i = 0; i < states.size(); ++i) {
    if (!getVisible(i)) continue;
    const Mat3 axes = states[i].orientation.toRotationMatrix();
    const Vec3& origin = states[i].position;
    for (int k = 0; k < 3; ++k) {
      callbacks.line(callbacks.context, origin, origin + scale * axes.col(k), kAxisColors[k]);
    }
  }
}

void DebugRender::renderIsland(uint32_t island, std::span<const uint32_t> bodies,
                               std::span<const RigidState> states, std::span<const Collidable> collidables) {
  if (callbacks.aabb == nullptr) return;
  Aabb box;
  for (uint32_t body : bodies) {
    if (body < states.size() && getVisible(body)) box.extend(bodyAabb(states[body], collidables[body]));
  }
  if (box.min.x() > box.max.x()) return;  // nothing visible in it
  callbacks.aabb(callbacks.context, box.center(), box.halfExtent(), indexColor(island));
}

void DebugRender::renderContact(std::span<const RigidState> states, const Pair& pair,
                                std::span<const ContactManifold> manifolds) {
  const auto draw = [&](const Vec3& point, const Vec3& outward) {
    if (callbacks.point != nullptr) callbacks.point(callbacks.context, point, kContactPointColor);
    if (callbacks.line != nullptr) {
      callbacks.line(callbacks.context, point, point + scale * outward, kContactNormalColor);
    }
  };
  if (std::max(pair.body_a, pair.body_b) >= states.size()) return;
  const Transform pose_a = states[pair.body_a].pose(), pose_b = states[pair.body_b].pose();
  const bool visible_a = getVisible(pair.body_a), visible_b = getVisible(pair.body_b);
  for (const ContactManifold& manifold : manifolds) {
    for (int i = 0; i < manifold.num_points; ++i) {
      const ContactPoint& point = manifold.points[static_cast<std::size_t>(i)];
      if (visible_a) draw(pose_a.apply(point.local_a), manifold.normal);
      if (visible_b) draw(pose_b.apply(point.local_b), -manifold.normal);
    }
  }
}

void DebugRender::renderContactDepth(std::span<const RigidState> states, const Pair& pair,
                                     std::span<const ContactManifold> manifolds, float exaggeration) {
  if (callbacks.line == nullptr || std::max(pair.body_a, pair.body_b) >= states.size()) return;
  if (!getVisible(pair.body_a) && !getVisible(pair.body_b)) return;
  const Transform pose_a = states[pair.body_a].pose();
  for (const ContactManifold& manifold : manifolds) {
    for (int i = 0; i < manifold.num_points; ++i) {
      const ContactPoint& point = manifold.points[static_cast<std::size_t>(i)];
      const Vec3 from = pose_a.apply(point.local_a);
      callbacks.line(callbacks.context, from, from + exaggeration * point.distance * manifold.normal,
                     point.distance < 0.0f ? kContactOverlapColor : kContactGapColor);
    }
  }
}

}  // namespace pfx
