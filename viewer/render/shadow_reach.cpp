#include "viewer/render/shadow_reach.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace viewer {

namespace {

using pfx::Vec3;

std::optional<float> lowestFloor(const DrawList& list) {
  std::optional<float> lowest;
  for (const auto& [key, batch] : list.batches())
    if (key.layer == Layer::Floor)
      for (const pfx::Aabb& block : batch.block_bounds) lowest = std::min(lowest.value_or(block.min.y()), block.min.y());
  return lowest;
}

}  // namespace

ScreenRect shadowReach(const DrawList& list, const SunView& sun, const FrameBlock& frame) {
  const auto floor = lowestFloor(list);
  if (sun.empty || !list.sun.shadows || !floor) return {};
  const int width = int(frame.viewport.x()), height = int(frame.viewport.y());
  const ScreenRect all = {0, 0, width, height};
  if (sun.to_sun.y() < 0.01f) return all;

  // The beam of the shadow map, a few texels wider than it, from its upper end down to the floor.
  constexpr float kWider = 1.02f, kNearPlane = 1e-3f;
  const Mat4 world_from_sun = sun.clip_from_world.inverse();
  float left = 1.0f, right = -1.0f, bottom = 1.0f, top = -1.0f;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec4 in_map(corner & 1 ? kWider : -kWider, corner & 2 ? kWider : -kWider, -1.0f, 1.0f);
    const Vec3 upper = (world_from_sun * in_map).head<3>();
    const Vec3 lower = upper - std::max(0.0f, (upper.y() - *floor) / sun.to_sun.y()) * sun.to_sun;
    for (const Vec3& p : {upper, lower}) {
      const Vec4 clip = frame.clip_from_world * p.homogeneous();
      if (clip.w() < kNearPlane) return all;
      left = std::min(left, clip.x() / clip.w()), right = std::max(right, clip.x() / clip.w());
      bottom = std::min(bottom, clip.y() / clip.w()), top = std::max(top, clip.y() / clip.w());
    }
  }
  const auto sample = [](float ndc, int size) { return (0.5f * std::clamp(ndc, -1.0f, 1.0f) + 0.5f) * float(size); };
  ScreenRect reach;
  reach.x = std::max(0, int(std::floor(sample(left, width))) - 1);
  reach.y = std::max(0, int(std::floor(sample(bottom, height))) - 1);
  reach.width = std::clamp(int(std::ceil(sample(right, width))) + 1 - reach.x, 0, width - reach.x);
  reach.height = std::clamp(int(std::ceil(sample(top, height))) + 1 - reach.y, 0, height - reach.y);
  return reach;
}

std::array<ScreenRect, 4> around(const ScreenRect& part, const FrameBlock& frame) {
  const int width = int(frame.viewport.x()), height = int(frame.viewport.y());
  const int right = part.x + part.width, top = part.y + part.height;
  return {ScreenRect{0, 0, width, part.y}, ScreenRect{0, top, width, height - top},
          ScreenRect{0, part.y, part.x, part.height}, ScreenRect{right, part.y, width - right, part.height}};
}

}  // namespace viewer
