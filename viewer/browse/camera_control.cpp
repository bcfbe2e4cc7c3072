#include "viewer/browse/camera_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viewer {

namespace {

constexpr float kMinDistance = 0.05f, kMaxDistance = 2000.0f;  // m
constexpr float kMaxPitch = 89.9f;

}  // namespace

Camera CameraControl::camera() const {
  Camera camera = orbitCamera(pose);
  camera.orthographic = orthographic;
  if (orthographic) camera.near_m = -camera.far_m;  // what is behind the eye is in the picture too
  return camera;
}

void CameraControl::orbit(float dx, float dy, int height) {
  const float degrees = 180.0f / float(std::max(height, 1));
  pose.yaw_deg = std::remainder(pose.yaw_deg - dx * degrees, 360.0f);
  pose.pitch_deg = std::clamp(pose.pitch_deg + dy * degrees, -kMaxPitch, kMaxPitch);
}

void CameraControl::pan(float dx, float dy, int height) {
  const Camera c = camera();
  const CameraAxes a = axes(c);
  const float metres = c.ortho_height_m / float(std::max(height, 1));
  pose.target += metres * (-dx * a.right + dy * a.up);
}

void CameraControl::zoom(float steps) {
  pose.distance = std::clamp(pose.distance * std::pow(0.9f, steps), kMinDistance, kMaxDistance);
}

void CameraControl::fly(const pfx::Vec3& local) {
  const CameraAxes a = axes(camera());
  pose.target += pose.distance * (local.x() * a.right + local.y() * a.up + local.z() * a.forward);
}

void CameraControl::frame(const pfx::Aabb& box) {
  const float radius = box.halfExtent().norm();
  if (box.min.x() > box.max.x() || !std::isfinite(radius)) return;
  pose.target = box.center();
  const float half_angle = 0.5f * camera().fov_y_deg * std::numbers::pi_v<float> / 180.0f;
  pose.distance = std::clamp(1.15f * radius / std::sin(half_angle), kMinDistance, kMaxDistance);
}

void CameraControl::lookFrom(float yaw_deg, float pitch_deg) {
  pose.yaw_deg = yaw_deg;
  pose.pitch_deg = std::clamp(pitch_deg, -kMaxPitch, kMaxPitch);
}

}  // namespace viewer
