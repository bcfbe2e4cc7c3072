// Runs a scene.
#include "viewer/run/scene_run.h"

#include <algorithm>
#include <array>

#include "pfx/util/state_hash/state_hash.h"

namespace viewer {
namespace {

pfx::WorldDef worldDef(const SceneSpec& spec, const RunSettings& settings) {
  pfx::WorldDef def = spec.world;
  def.substeps = settings.substeps.value_or(def.substeps);
  def.joint_solver = settings.joint_solver.value_or(def.joint_solver);
  def.contact_solver = settings.contact_solver.value_or(def.contact_solver);
  def.workers = settings.threads;
  return def;
}

}  // namespace

SceneRun::SceneRun(const SceneSpec& spec, const RunSettings& settings)
    : spec_(spec), settings_(settings), world_(worldDef(spec, settings)), scene_(spec.make()) {
  std::vector<samples::Parameter> parameters = scene_->parameters();
  for (size_t i = 0; i < std::min(parameters.size(), settings_.parameters.size()); ++i)
    *parameters[i].value = std::clamp(settings_.parameters[i], parameters[i].low, parameters[i].high);
  scene_->build(world_);
}

void SceneRun::step() {
  scene_->beforeStep(world_, settings_.dt);
  world_.step(settings_.dt);
  scene_->afterStep(world_, settings_.dt);
}

uint64_t SceneRun::stateHash() const {
  const uint64_t own = scene_->stateHash();
  if (own == 0) return world_.stateHash();
  const std::array<uint64_t, 2> both = {world_.stateHash(), own};
  return pfx::hashBytes(std::as_bytes(std::span(both)));
}

void SceneRun::stepTo(uint64_t steps) {
  while (world_.stepCount() < steps) step();
}

}  // namespace viewer
