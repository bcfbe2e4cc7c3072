#include "viewer/render/frame_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viewer {

namespace {

using pfx::Vec3;

// Bounds of all that throws shadows, cut to the neighbourhood of what the camera looks at.
pfx::Aabb casterBounds(const DrawList& list) {
  const float reach = 2.5f * (list.camera.target - list.camera.eye).norm();
  const pfx::Aabb near = {list.camera.target - Vec3::Constant(reach), list.camera.target + Vec3::Constant(reach)};
  pfx::Aabb all;
  for (const auto& [key, batch] : list.batches()) {
    if (!throwsShadow(key.layer)) continue;
    for (size_t b = 0; b < batch.block_bounds.size(); ++b) {
      const pfx::Aabb& block = batch.block_bounds[b];
      if (near.contains(block)) {
        all.extend(block);
      } else if (near.overlaps(block)) {
        for (const Instance& i : batch.block(b))
          if (const pfx::Aabb box = list.boundsOf(key.mesh, i); box.overlaps(near)) all.extend(box);
      }
    }
  }
  if (all.min.x() > all.max.x()) return all;
  return {all.min.cwiseMax(near.min), all.max.cwiseMin(near.max)};
}

}  // namespace

SunView fitSun(const DrawList& list, int map_size) {
  SunView view;
  view.to_sun = -list.sun.direction.normalized();
  const pfx::Aabb bounds = casterBounds(list);
  view.empty = bounds.min.x() > bounds.max.x();
  const Vec3 center = view.empty ? list.camera.target : bounds.center();
  const Vec3 half = view.empty ? Vec3(Vec3::Ones()) : bounds.halfExtent();
  const pfx::TangentPair t = pfx::tangents(view.to_sun);
  // One texel of room on each side, so that the edge of the map is always lit.
  const float room = 1.0f + 4.0f / float(map_size);
  const float x = t.t1.cwiseAbs().dot(half) * room + 1e-3f, y = t.t2.cwiseAbs().dot(half) * room + 1e-3f;
  // Receivers lie behind the casters: the depth reaches further away from the sun than towards it.
  const float z = view.to_sun.cwiseAbs().dot(half) + 0.1f, behind = 3.0f * z + 10.0f;
  const float side = std::max(x, y);
  view.texel_m = 2.0f * side / float(map_size);

  Mat4 m = Mat4::Identity();
  const auto row = [&](int r, const Vec3& axis, float scale, float offset) {
    m.row(r) << axis.x() * scale, axis.y() * scale, axis.z() * scale, offset - axis.dot(center) * scale;
  };
  row(0, t.t1, 1.0f / side, 0.0f);
  row(1, t.t2, 1.0f / side, 0.0f);
  const float depth = 2.0f / (z + behind);
  row(2, view.to_sun, -depth, z * depth - 1.0f);
  view.clip_from_world = m;
  return view;
}

FrameBlock makeFrameBlock(const DrawList& list, const FrameSize& size, const SunView& sun, int map_size) {
  const Camera& c = list.camera;
  const CameraAxes a = axes(c);
  const float aspect = float(size.width) / float(size.height);
  const float up = float(std::tan(0.5 * c.fov_y_deg * std::numbers::pi / 180.0));
  const auto with = [](const Vec3& v, float w) { return Vec4(v.x(), v.y(), v.z(), w); };

  FrameBlock f;
  f.clip_from_world = projectionMatrix(c, aspect) * viewMatrix(c);
  Mat4 to_map = Mat4::Identity();
  to_map.diagonal() << 0.5f, 0.5f, 0.5f, 1.0f;
  to_map.col(3) << 0.5f, 0.5f, 0.5f, 1.0f;
  f.sun_from_world = to_map * sun.clip_from_world;
  f.eye = with(c.eye, c.orthographic ? 0.0f : 1.0f);
  f.ray_right = with(up * aspect * a.right, 0.0f);
  f.ray_up = with(up * a.up, 0.0f);
  f.ray_forward = with(a.forward, 0.0f);
  f.sun = with(sun.to_sun, list.sun.shadows && !sun.empty ? 1.0f : 0.0f);
  const float w = float(size.width * size.side), h = float(size.height * size.side);
  f.viewport = Vec4(w, h, 1.0f / w, 1.0f / h);
  f.shadow = Vec4(1.0f / float(map_size), sun.texel_m, map_size > 1024 ? 3.2f : 1.8f, 0.0f);
  const float distance = (c.target - c.eye).norm();
  f.fog = Vec4(3.0f * distance, 1.0f / (6.0f * distance + 1e-6f), float(size.side), 0.0f);
  f.floor_fade = with(c.target, 1.0f / (1.4f * distance + 1e-3f));
  return f;
}

}  // namespace viewer
