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
#include "samples/canvas.h"

namespace samples {

// Orbit camera. Y is up; yaw 0 looks along -Z, positive yaw moves the eye towards +X.
struct CameraPose {
  pfx::Vec3 target = pfx::Vec3::Zero();  // m
  float distance = 20.0f;                // m from the target
  float yaw_deg = 30.0f;
  float pitch_deg = 20.0f;               // positive: from above
};

// A number that may be changed while the scene runs, or takes effect when it is built again.
struct Parameter {
  enum class Takes { AtOnce, OnRestart };
  std::string_view name, unit;
  float* value;
  float low, high;
  Takes takes = Takes::AtOnce;
};

// A number that proves the scene's point, now.
struct Reading {
  std::string_view name, unit;
  double value;
  double limit = 0.0;  // the value that it must not exceed; 0: none
};

// What a person asks of the scene with the keyboard, in the camera's frame.
struct Controls {
  float right = 0.0f, forward = 0.0f;  // -1 .. 1
  float heading = 0.0f;                // rad, yaw of the camera
  bool run = false, jump = false, crouch = false;
};

// What is special about a scene. Everything but build() may be left out.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual void build(pfx::World& world) = 0;                  // adds bodies and joints to an empty world
  virtual void beforeStep(pfx::World& world, float dt) { (void)world, (void)dt; }  // scripted motion
  virtual void afterStep(pfx::World& world, float dt) { (void)world, (void)dt; }
  virtual void draw(const pfx::World& world, Canvas& canvas) const { (void)world, (void)canvas; }
  // By body: what its solids are drawn in; 0 or missing: the colour of its state.
  virtual std::vector<pfx::Color> bodyColors(const pfx::World& world) const { return (void)world, std::vector<pfx::Color>(); }

  // Hash of what the scene simulates besides the world; 0 when there is nothing.
  virtual uint64_t stateHash() const { return 0; }

  // Valid as long as the scene; asked for before build() as well.
  virtual std::vector<Parameter> parameters() { return {}; }
  virtual std::vector<Reading> readings(const pfx::World& world) const { return (void)world, std::vector<Reading>(); }

  // A scene that a person can steer says so; it follows its script until the first call of control().
  virtual bool isControlled() const { return false; }
  virtual void control(const Controls& controls) { (void)controls; }
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
