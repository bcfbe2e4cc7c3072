// Moves the camera of the browser. The state is the orbit pose of a sample plus the kind of projection.
#pragma once

#include "pfx/base_level/shape/aabb.h"
#include "viewer/draw_list/camera.h"

namespace viewer {

struct CameraControl {
  samples::CameraPose pose;
  bool orthographic = false;

  Camera camera() const;

  // Turns by a mouse movement in pixels; 180 degrees for `height` of the window.
  void orbit(float dx, float dy, int height);
  // Shifts so that what is at the target's distance stays under the mouse.
  void pan(float dx, float dy, int height);
  // Positive steps come nearer, by a tenth of the distance each.
  void zoom(float steps);
  // Flies by `local` (right, up, forwards), in distances to the target per call.
  void fly(const pfx::Vec3& local);
  // Looks at all of a box from the direction it looks in now. An empty box changes nothing.
  void frame(const pfx::Aabb& box);
  void lookFrom(float yaw_deg, float pitch_deg);
};

}  // namespace viewer
