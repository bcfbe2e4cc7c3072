// A scene as data: what a file says, before a world is made of it.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/high_level/world/world.h"

namespace pfx {

struct SceneBody {
  BodyDef def;            // shapes point at the meshes of the scene
  bool can_sleep = true;
  std::string place;      // where it was read, for messages: "scene.xml:12: <body>"
};

struct SceneJoint {
  JointDef def;           // the ids of its bodies are set when the world is made
  uint32_t body_a = 0, body_b = 0;           // indices of SceneDef::bodies
  std::vector<std::pair<int, AxisConstraint>> axes;  // replace those of the kind
  std::string place;
};

// Two bodies that do not collide.
struct SceneApart {
  uint32_t body_a = 0, body_b = 0;  // indices of SceneDef::bodies
  std::string place;
};

struct SceneParticles {
  ParticleDef def;  // its anchors name bodies by their index in SceneDef::bodies
  std::string place;
};

struct SceneDef {
  WorldDef world;
  std::deque<ConvexMesh> convex_meshes;  // addresses stay
  std::deque<LargeMesh> large_meshes;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneApart> apart;
  std::vector<SceneParticles> particles;
};

// Adds the scene's meshes, bodies, joints and particles, in their order, to a world. Throws SceneError naming the
// place when the world refuses one.
void buildScene(const SceneDef& scene, World& world);

}  // namespace pfx
