#include "viewer/draw_list/camera.h"

#include <cmath>
#include <numbers>

namespace viewer {

namespace {

// In double and rounded once, so that the last bits of a C library's functions do not reach the matrices.
float tanDeg(double deg) { return float(std::tan(deg * std::numbers::pi / 180.0)); }
float sinDeg(double deg) { return float(std::sin(deg * std::numbers::pi / 180.0)); }
float cosDeg(double deg) { return float(std::cos(deg * std::numbers::pi / 180.0)); }

}  // namespace

CameraAxes axes(const Camera& camera) {
  pfx::Vec3 forward = camera.target - camera.eye;
  const float length = forward.norm();
  forward = length > 0.0f ? pfx::Vec3(forward / length) : pfx::Vec3(0, 0, -1);
  pfx::Vec3 right = forward.cross(camera.up);
  // Looking straight along `up`: any right-hand axis will do.
  if (right.norm() < 1e-5f)
    right = forward.cross(std::abs(forward.z()) < 0.9f ? pfx::Vec3(0, 0, -1) : pfx::Vec3(1, 0, 0));
  right.normalize();
  return {right, right.cross(forward), forward};
}

Mat4 viewMatrix(const Camera& camera) {
  const CameraAxes a = axes(camera);
  Mat4 m = Mat4::Identity();
  m.row(0) << a.right.x(), a.right.y(), a.right.z(), -a.right.dot(camera.eye);
  m.row(1) << a.up.x(), a.up.y(), a.up.z(), -a.up.dot(camera.eye);
  m.row(2) << -a.forward.x(), -a.forward.y(), -a.forward.z(), a.forward.dot(camera.eye);
  return m;
}

Mat4 projectionMatrix(const Camera& camera, float aspect) {
  const float n = camera.near_m, f = camera.far_m;
  Mat4 m = Mat4::Zero();
  if (camera.orthographic) {
    m(1, 1) = 2.0f / camera.ortho_height_m;
    m(0, 0) = m(1, 1) / aspect;
    m(2, 2) = -2.0f / (f - n);
    m(2, 3) = -(f + n) / (f - n);
    m(3, 3) = 1.0f;
  } else {
    m(1, 1) = 1.0f / tanDeg(0.5 * camera.fov_y_deg);
    m(0, 0) = m(1, 1) / aspect;
    m(2, 2) = -(f + n) / (f - n);
    m(2, 3) = -2.0f * f * n / (f - n);
    m(3, 2) = -1.0f;
  }
  return m;
}

PickRay pickRay(const Camera& camera, float x, float y, int width, int height) {
  const CameraAxes a = axes(camera);
  const float aspect = float(width) / float(height);
  const float u = (2.0f * x / float(width) - 1.0f) * aspect, v = 1.0f - 2.0f * y / float(height);
  if (camera.orthographic) {
    const float half = 0.5f * camera.ortho_height_m;
    return {camera.eye + half * (u * a.right + v * a.up), a.forward};
  }
  const float t = tanDeg(0.5 * camera.fov_y_deg);
  return {camera.eye, (a.forward + t * (u * a.right + v * a.up)).normalized()};
}

Camera orbitCamera(const samples::CameraPose& pose) {
  Camera camera;
  const float cp = cosDeg(pose.pitch_deg);
  camera.target = pose.target;
  camera.eye = pose.target + pose.distance * pfx::Vec3(sinDeg(pose.yaw_deg) * cp, sinDeg(pose.pitch_deg),
                                                       cosDeg(pose.yaw_deg) * cp);
  // The depth buffer's precision is spent where the scene is.
  camera.near_m = std::max(0.02f, 0.01f * pose.distance);
  camera.far_m = std::max(400.0f, 40.0f * pose.distance);
  camera.ortho_height_m = 2.0f * pose.distance * tanDeg(0.5 * camera.fov_y_deg);
  return camera;
}

}  // namespace viewer
