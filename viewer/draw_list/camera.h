// The camera of a picture, its matrices, and the orbit pose that samples describe it with.
// Right-handed, y up, the camera looks along its own -Z; clip space is GL's.
#pragma once

#include <Eigen/Core>

#include "pfx/base_level/math/vector.h"
#include "samples/scene.h"

namespace viewer {

using Mat4 = Eigen::Matrix<float, 4, 4, Eigen::DontAlign>;

struct Camera {
  pfx::Vec3 eye = pfx::Vec3(8.0f, 6.0f, 14.0f);  // m
  pfx::Vec3 target = pfx::Vec3::Zero();          // m
  pfx::Vec3 up = pfx::Vec3::UnitY();
  float fov_y_deg = 40.0f;  // full vertical angle
  float near_m = 0.05f;     // distance of the near plane, > 0
  float far_m = 1000.0f;
  bool orthographic = false;
  float ortho_height_m = 10.0f;  // full height of the picture, orthographic only

  bool operator==(const Camera&) const = default;
};

// The orthonormal axes of a camera, in the world.
struct CameraAxes {
  pfx::Vec3 right, up, forward;
};
CameraAxes axes(const Camera& camera);

Mat4 viewMatrix(const Camera& camera);
Mat4 projectionMatrix(const Camera& camera, float aspect);  // aspect: width / height

// A ray into the scene through a pixel position (0,0 is the top left corner of a width x height picture).
struct PickRay {
  pfx::Vec3 origin;     // m
  pfx::Vec3 direction;  // unit
};
PickRay pickRay(const Camera& camera, float x, float y, int width, int height);

Camera orbitCamera(const samples::CameraPose& pose);

}  // namespace viewer
