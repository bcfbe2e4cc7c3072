// A sample scene: data, and the few lines that are special in it.
//
// A scene knows the engine but no GL. The same table feeds the browser, the golden images, the tests and the
// benchmarks.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace samples {

// Orbit camera. Y is up; yaw 0 looks along -Z, positive yaw moves the eye towards +X.
struct CameraPose {
  pfx::Vec3 target = pfx::Vec3::Zero();  // m
  float distance = 20.0f;                // m from the target
  float yaw_deg = 30.0f;
  float pitch_deg = 20.0f;               // positive: from above
};

class Scene {
 public:
  virtual ~Scene() = default;
  virtual void build(pfx::World& world) = 0;                  // adds bodies and joints to an empty world
  virtual void beforeStep(pfx::World& world, float dt) { (void)world, (void)dt; }  // scripted motion
};

struct SceneEntry {
  std::string_view sample;     // "2_stable"
  std::string_view name;       // "tower"
  std::string_view shows;      // one line: what to look at
  CameraPose camera;
  std::vector<int> frames;     // golden frames
  pfx::WorldDef world;
  std::unique_ptr<Scene> (*make)();
};

inline constexpr float kTimeStep = 1.0f / 60.0f;  // s, of every scene

// All scenes, in the order of the browser.
std::span<const SceneEntry> scenes();

// The scenes that TARGET names: "SAMPLE" or "SAMPLE/SCENE". Empty when there is none.
std::vector<const SceneEntry*> findScenes(std::string_view target);

}  // namespace samples
