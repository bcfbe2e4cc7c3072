// Which instances a pass can see, in blocks.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "viewer/draw_list/camera.h"
#include "viewer/draw_list/draw_list.h"

namespace viewer {

// The six planes of a clip volume: n . p + d >= 0 inside.
// G. Gribb, K. Hartmann, Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix, 2001.
class Frustum {
 public:
  explicit Frustum(const Mat4& clip_from_world) {
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const float sign = side == 0 ? 1.0f : -1.0f;
        planes_[size_t(2 * axis + side)] = (clip_from_world.row(3) + sign * clip_from_world.row(axis)).transpose();
      }
  }

  // False only when nothing of the box is inside; rounding counts in favour of the box.
  bool maySee(const pfx::Aabb& box) const {
    const pfx::Vec3 c = box.center(), h = 1.001f * box.halfExtent() + pfx::Vec3::Constant(1e-3f);
    return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& p) {
      const pfx::Vec3 n = p.head<3>();
      return n.dot(c) + n.cwiseAbs().dot(h) + p.w() >= 0.0f;
    });
  }

 private:
  using Plane = Eigen::Matrix<float, 4, 1, Eigen::DontAlign>;
  std::array<Plane, 6> planes_;
};

// Calls use(first, count) for each run of instances whose blocks may be seen; all of them when bounds are not known.
template <class Use>
void forVisibleRuns(const Frustum& frustum, std::span<const pfx::Aabb> block_bounds, size_t instances, const Use& use) {
  if (block_bounds.empty()) return use(size_t(0), instances);
  for (size_t b = 0; b < block_bounds.size(); ++b) {
    if (!frustum.maySee(block_bounds[b])) continue;
    const size_t first = b;
    while (b < block_bounds.size() && frustum.maySee(block_bounds[b])) ++b;
    use(first * Batch::kBlock, std::min(b * Batch::kBlock, instances) - first * Batch::kBlock);
  }
}

}  // namespace viewer
