// A scene that is being run: its world and its script.
#pragma once

#include <memory>
#include <optional>

#include "pfx/high_level/world/world.h"
#include "viewer/run/scene_spec.h"

namespace viewer {

// What a caller may change about a scene. What is not set is as the scene has it.
struct RunSettings {
  float dt = samples::kTimeStep;  // s, > 0
  std::optional<int> substeps = {};  // >= 1
  std::optional<pfx::JointSolver> joint_solver = {};
  std::optional<pfx::ContactSolver> contact_solver = {};
  int threads = 1;                // the caller included; does not change the result
  std::vector<float> parameters = {};  // of the scene, before it is built; those that are missing are the scene's own
};

class SceneRun {
 public:
  // Builds the scene. Throws what the scene throws.
  explicit SceneRun(const SceneSpec& spec, const RunSettings& settings = {});

  void step();                  // the scene's script round one step of the world
  void stepTo(uint64_t steps);  // until so many steps were made

  void setTimeStep(float dt) { settings_.dt = dt; }  // s, > 0, from the next step on

  const SceneSpec& spec() const { return spec_; }
  const RunSettings& settings() const { return settings_; }
  pfx::World& world() { return world_; }
  const pfx::World& world() const { return world_; }
  samples::Scene& scene() { return *scene_; }
  const samples::Scene& scene() const { return *scene_; }

  // Of the world, and of what the scene simulates besides it.
  uint64_t stateHash() const;

 private:
  SceneSpec spec_;
  RunSettings settings_;
  pfx::World world_;
  std::unique_ptr<samples::Scene> scene_;
};

}  // namespace viewer
