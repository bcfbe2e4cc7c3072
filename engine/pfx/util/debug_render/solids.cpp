// Retained drawing: bodies sorted into groups of equal geometry.
//
// The shapes of a scene hardly ever change, so each shape first asks whether it still belongs to its group of
// the last frame, which is a comparison of a few floats; only a shape that does not is looked up.
#include <algorithm>

#include "pfx/util/debug_render/debug_render.h"
#include "pfx/util/debug_render/geometry_key.h"
#include "pfx/util/debug_render/palette.h"

namespace pfx {

namespace {

constexpr uint32_t kNoGroup = 0xffffffffu;

// A body without extent was never finished, or has been removed from its world.
bool isDrawable(const Collidable& collidable) { return !collidable.half_extent.isZero(0.0f); }

}  // namespace

uint32_t DebugRender::groupOf(const Geometry& geometry) {
  const auto [known, is_new] = group_of_identity_.try_emplace(geometryIdentity(geometry), kNoGroup);
  if (!is_new) return known->second;
  const uint64_t key = geometryKey(geometry);
  const auto same_content = std::ranges::find(groups_, key, &Group::key);
  known->second = static_cast<uint32_t>(same_content - groups_.begin());
  if (same_content == groups_.end()) {
    groups_.push_back({geometry, key, {}});
    if (callbacks.define_solid != nullptr) callbacks.define_solid(callbacks.context, key, geometry);
  }
  return known->second;
}

void DebugRender::addInstances(uint32_t body, const RigidState& state, std::span<const Shape> shapes,
                               std::span<uint32_t> groups) {
  const Transform pose = state.pose();
  const Look look = bodyLook(state, body);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    uint32_t& group = groups[i];
    if (group == kNoGroup || !sameGeometry(groups_[group].geometry, shapes[i].geometry)) {
      group = groupOf(shapes[i].geometry);
    }
    groups_[group].instances.push_back({pose * shapes[i].offset, look.color, look.finish, body});
  }
}

void DebugRender::renderSolids(std::span<const RigidState> states, std::span<const Collidable> collidables) {
  if (callbacks.draw_solids == nullptr) return;
  for (Group& group : groups_) group.instances.clear();
  std::size_t first = 0;
  for (uint32_t body = 0; body < states.size(); ++body) {
    const std::span<const Shape> shapes = collidables[body].shapes();
    if (last_group_.size() < first + shapes.size()) last_group_.resize(first + shapes.size(), kNoGroup);
    if (getVisible(body) && isDrawable(collidables[body])) {
      addInstances(body, states[body], shapes, std::span(last_group_).subspan(first, shapes.size()));
    }
    first += shapes.size();
  }
  for (const Group& group : groups_) {
    if (!group.instances.empty()) callbacks.draw_solids(callbacks.context, group.key, group.instances);
  }
}

void DebugRender::forgetSolids() {
  groups_.clear();
  group_of_identity_.clear();
  last_group_.clear();
}

}  // namespace pfx
