// Floors are drawn without a look at the shadow map only where no shadow can fall.
#include "viewer/render/shadow_reach.h"

#include <gtest/gtest.h>

#include <random>

namespace viewer {
namespace {

using pfx::Vec3;

constexpr int kMap = 1024;

DrawList boxOnFloor(const samples::CameraPose& camera) {
  DrawList list;
  list.begin();
  list.camera = orbitCamera(camera);
  list.add(kUnitBox, {.position = Vec3(0, -0.5f, 0), .scale = Vec3(40, 0.5f, 40), .finish = uint32_t(pfx::Finish::Matte)});
  list.add(kUnitBox, {.position = Vec3(0, 1, 0)});
  list.end();
  return list;
}

TEST(ShadowReach, HoldsEveryPointOfAFloorThatTheShadowMapCovers) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-12.0f, 12.0f), turn(0.0f, 360.0f), pitch(-5.0f, 80.0f);
  int covered = 0;
  for (int view = 0; view < 50; ++view) {
    const float yaw = turn(random), down = pitch(random);
    const DrawList list = boxOnFloor({.target = Vec3(0, 1, 0), .distance = 12, .yaw_deg = yaw, .pitch_deg = down});
    const SunView sun = fitSun(list, kMap);
    const FrameBlock frame = makeFrameBlock(list, {640, 360, 2}, sun, kMap);
    const ScreenRect reach = shadowReach(list, sun, frame);
    for (int i = 0; i < 2000; ++i) {
      const float x = place(random), z = place(random);
      const Vec4 in_map = sun.clip_from_world * Vec3(x, 0, z).homogeneous();
      const Vec4 clip = frame.clip_from_world * Vec3(x, 0, z).homogeneous();
      if (std::abs(in_map.x()) > 1.0f || std::abs(in_map.y()) > 1.0f || std::abs(clip.x()) > clip.w() ||
          std::abs(clip.y()) > clip.w())
        continue;
      ++covered;
      const float sx = (0.5f * clip.x() / clip.w() + 0.5f) * 1280.0f, sy = (0.5f * clip.y() / clip.w() + 0.5f) * 720.0f;
      EXPECT_TRUE(sx >= float(reach.x) && sx <= float(reach.x + reach.width) && sy >= float(reach.y) &&
                  sy <= float(reach.y + reach.height))
          << sx << " " << sy << " seen from " << yaw << " " << down;
    }
  }
  EXPECT_GT(covered, 500);
}

TEST(ShadowReach, IsSmallRoundASmallThingAndNothingWithoutShadows) {
  DrawList list = boxOnFloor({.target = Vec3(0, 1, 0), .distance = 30, .yaw_deg = 30, .pitch_deg = 25});
  const SunView sun = fitSun(list, kMap);
  const FrameBlock frame = makeFrameBlock(list, {640, 360, 2}, sun, kMap);
  const ScreenRect reach = shadowReach(list, sun, frame);
  EXPECT_LT(reach.width * reach.height, 1280 * 720 / 10);
  int samples = reach.width * reach.height;
  for (const ScreenRect& rest : around(reach, frame)) samples += rest.width * rest.height;
  EXPECT_EQ(samples, 1280 * 720) << "each sample is in one part";
  list.sun.shadows = false;
  EXPECT_EQ(shadowReach(list, sun, frame).width, 0);
}

}  // namespace
}  // namespace viewer
