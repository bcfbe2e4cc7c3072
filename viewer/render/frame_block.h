// The uniform block that all passes share (shaders/frame.glsl), and the fitting of the sun's view to a scene.
#pragma once

#include "viewer/draw_list/draw_list.h"

namespace viewer {

using Vec4 = Eigen::Matrix<float, 4, 1, Eigen::DontAlign>;

struct FrameBlock {
  Mat4 clip_from_world;
  Mat4 sun_from_world;
  Vec4 eye, ray_right, ray_up, ray_forward, sun, viewport, shadow, fog, floor_fade;
};
static_assert(sizeof(FrameBlock) == 2 * 64 + 9 * 16);

// The sun's orthographic view of what can throw a shadow into the picture.
struct SunView {
  Mat4 clip_from_world;
  pfx::Vec3 to_sun;  // unit
  float texel_m;     // side of a texel of the shadow map
  bool empty;        // nothing throws a shadow
};
SunView fitSun(const DrawList& list, int map_size);

struct FrameSize {
  int width, height;  // px
  int side;           // samples along a pixel's side
};
FrameBlock makeFrameBlock(const DrawList& list, const FrameSize& size, const SunView& sun, int map_size);

}  // namespace viewer
