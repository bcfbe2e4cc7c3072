// Robots in URDF files (Unified Robot Description Format), read with liburdfdom.
//
// Every link becomes a body at the pose that it has when all joint positions are zero, every joint the joint of the same
// kind between two bodies: revolute and continuous a hinge, prismatic a slider, fixed and planar a record with those axes
// locked; a floating one is none. URDF has z up, the world y: the whole model is turned. Collision shapes come from
// <collision>, or where there is none from <visual>; a mesh must be an OBJ file and becomes its convex hull. The friction
// of a joint is a motor that wants it at rest and is as strong as that. Limits of effort and speed belong to a drive that
// the file does not describe, and viscous damping has no counterpart: both are left out.
#pragma once

#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {

struct UrdfOptions {
  Vec3 position = Vec3::Zero();  // m, of the root link
  bool fixed_root = true;        // the root link does not move; otherwise it must have a mass
};

// Whether the engine was built with liburdfdom. Without it readUrdf() throws a SceneError that says so.
bool canReadUrdf();

// Reads a model. Throws SceneError naming the file, and the line or the link and the cause.
SceneDef readUrdf(const std::filesystem::path& path, const UrdfOptions& options = {});
SceneDef readUrdf(const SceneText& text, const UrdfOptions& options = {});

}  // namespace pfx
