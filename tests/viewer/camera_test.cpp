// Camera matrices, pick rays and the browser's camera control.
#include "viewer/draw_list/camera.h"

#include <gtest/gtest.h>

#include "viewer/browse/camera_control.h"

namespace viewer {
namespace {

using pfx::Vec3;

Vec3 project(const Camera& camera, const Vec3& p, float aspect) {
  const Eigen::Vector4f clip = projectionMatrix(camera, aspect) * viewMatrix(camera) * p.homogeneous();
  return clip.hnormalized();
}

TEST(Camera, OrbitPosesFollowTheirDefinition) {
  // Yaw 0 looks along -Z; positive yaw moves the eye towards +X; positive pitch looks from above.
  EXPECT_LT((orbitCamera({.distance = 5, .yaw_deg = 0, .pitch_deg = 0}).eye - Vec3(0, 0, 5)).norm(), 1e-6f);
  EXPECT_LT((orbitCamera({.distance = 5, .yaw_deg = 90, .pitch_deg = 0}).eye - Vec3(5, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((orbitCamera({.distance = 5, .yaw_deg = 0, .pitch_deg = 90}).eye - Vec3(0, 5, 0)).norm(), 1e-6f);
}

TEST(Camera, TheTargetIsInTheMiddleAndDepthGrowsAwayFromTheEye) {
  for (const bool orthographic : {false, true}) {
    Camera c = orbitCamera({.target = Vec3(1, 2, 3), .distance = 10, .yaw_deg = 37, .pitch_deg = 21});
    c.orthographic = orthographic;
    const Vec3 middle = project(c, c.target, 1.5f);
    EXPECT_LT(middle.head<2>().norm(), 1e-5f);
    const Vec3 beyond = c.target + axes(c).forward;
    EXPECT_GT(project(c, beyond, 1.5f).z(), middle.z());
  }
}

TEST(Camera, APickRayPassesThroughWhatItsPixelShows) {
  for (const bool orthographic : {false, true}) {
    Camera c = orbitCamera({.target = Vec3(1, 2, 3), .distance = 10, .yaw_deg = -50, .pitch_deg = 33});
    c.orthographic = orthographic;
    const Vec3 point(2.0f, 1.0f, 4.5f);
    const Vec3 ndc = project(c, point, 16.0f / 9.0f);
    const PickRay ray = pickRay(c, (ndc.x() + 1) * 320, (1 - ndc.y()) * 180, 640, 360);
    const Vec3 away = point - ray.origin;
    // 1e-4 m: rounding of a chain of some ten operations on values near 10.
    EXPECT_LT((away - ray.direction * away.dot(ray.direction)).norm(), 1e-4f);
  }
}

TEST(Camera, LookingStraightDownStillHasAxes) {
  Camera c;
  c.eye = Vec3(0, 10, 0);
  c.target = Vec3::Zero();
  const CameraAxes a = axes(c);
  EXPECT_NEAR(a.right.norm(), 1.0f, 1e-6f);
  EXPECT_NEAR(a.right.dot(a.forward), 0.0f, 1e-6f);
}

TEST(CameraControl, PanningKeepsTheTargetPlaneUnderTheMouse) {
  CameraControl control{.pose = {.target = Vec3(0, 1, 0), .distance = 8, .yaw_deg = 20, .pitch_deg = 30}};
  const Vec3 held = control.pose.target;
  control.pan(40.0f, -25.0f, 360);
  const Vec3 ndc = project(control.camera(), held, 16.0f / 9.0f);
  // In pixels; a fortieth of one is lost to rounding at most.
  EXPECT_NEAR(ndc.x() * 320.0f, 40.0f, 0.025f);
  EXPECT_NEAR(-ndc.y() * 180.0f, -25.0f, 0.025f);
}

TEST(CameraControl, FramingShowsAllOfABox) {
  CameraControl control{.pose = {.yaw_deg = 130, .pitch_deg = -10}};
  const pfx::Aabb box{Vec3(-3, 0, 4), Vec3(5, 2, 9)};
  control.frame(box);
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                      i & 4 ? box.max.z() : box.min.z());
    const Vec3 ndc = project(control.camera(), corner, 1.0f);
    EXPECT_LT(ndc.cwiseAbs().maxCoeff(), 1.0f);
  }
  const samples::CameraPose before = control.pose;
  control.frame({});
  EXPECT_EQ(control.pose.distance, before.distance);
}

TEST(CameraControl, PitchAndDistanceStayInTheirLimits) {
  CameraControl control;
  control.orbit(0.0f, 1e6f, 100);
  EXPECT_LT(control.pose.pitch_deg, 90.0f);
  control.zoom(1000.0f);
  EXPECT_GT(control.pose.distance, 0.0f);
  control.zoom(-10000.0f);
  EXPECT_TRUE(std::isfinite(control.pose.distance));
}

}  // namespace
}  // namespace viewer
