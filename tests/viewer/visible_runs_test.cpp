// What the passes leave out: only blocks that no point of the clip volume lies in.
#include "viewer/render/visible_runs.h"

#include <gtest/gtest.h>

#include <random>

namespace viewer {
namespace {

using pfx::Aabb;
using pfx::Vec3;

Frustum frustumOf(const Camera& camera) { return Frustum(projectionMatrix(camera, 16.0f / 9.0f) * viewMatrix(camera)); }

bool isInside(const Mat4& clip_from_world, const Vec3& p) {
  const Eigen::Vector4f c = clip_from_world * p.homogeneous();
  return std::max({std::abs(c.x()), std::abs(c.y()), std::abs(c.z())}) <= c.w();
}

TEST(VisibleRuns, ABoxWithAPointInViewIsNeverLeftOut) {
  Camera camera;
  const Mat4 clip = projectionMatrix(camera, 16.0f / 9.0f) * viewMatrix(camera);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-40.0f, 40.0f), size(0.01f, 4.0f);
  int seen = 0, left_out = 0;
  for (int i = 0; i < 20000; ++i) {
    const float x = place(random), y = place(random), z = place(random), s = size(random);
    const Aabb box = {Vec3(x - s, y - s, z - s), Vec3(x + s, y + s, z + s)};
    const bool may_see = frustumOf(camera).maySee(box);
    bool sees = isInside(clip, Vec3(x, y, z));
    for (int k = 0; k < 8; ++k) sees |= isInside(clip, Vec3(x, y, z) + s * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    EXPECT_TRUE(may_see || !sees) << x << " " << y << " " << z << " " << s;
    seen += sees, left_out += !may_see;
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(left_out, 10000);
}

TEST(VisibleRuns, NeighbouringBlocksAreOneRunAndTheLastBlockEndsWithTheInstances) {
  Camera camera = orbitCamera({.target = Vec3::Zero(), .distance = 10, .yaw_deg = 0, .pitch_deg = 0});
  const Aabb here = {-Vec3::Ones(), Vec3::Ones()}, behind = {Vec3(-1, -1, 30), Vec3(1, 1, 32)};
  const std::vector<Aabb> blocks = {behind, here, here, behind, here};
  std::vector<std::pair<size_t, size_t>> runs;
  const auto note = [&](size_t first, size_t count) { runs.emplace_back(first, count); };
  forVisibleRuns(frustumOf(camera), blocks, 4 * Batch::kBlock + 3, note);
  const std::vector<std::pair<size_t, size_t>> expected = {{Batch::kBlock, 2 * Batch::kBlock}, {4 * Batch::kBlock, 3}};
  EXPECT_EQ(runs, expected);
  runs.clear();
  forVisibleRuns(frustumOf(camera), {}, 7, note);
  EXPECT_EQ(runs.size(), 1u);
}

TEST(VisibleRuns, BoundsOfABlockFollowItsInstances) {
  DrawList list;
  const auto frame = [&](float x, int count) {
    list.begin();
    for (int i = 0; i < count; ++i) list.add(kUnitBox, {.position = Vec3(i == 0 ? x : 0.0f, 0, 0), .scale = Vec3(1, 2, 3)});
    list.end();
    return list.batches().at({kUnitBox, Layer::Plain}).block_bounds;
  };
  EXPECT_EQ(frame(5.0f, 70).front().max, Vec3(6, 2, 3));
  EXPECT_EQ(frame(5.0f, 70).size(), 2u);
  EXPECT_EQ(frame(-5.0f, 70).front().max, Vec3(1, 2, 3));
  EXPECT_EQ(frame(-5.0f, 1).front().max, Vec3(-4, 2, 3));
}

}  // namespace
}  // namespace viewer
