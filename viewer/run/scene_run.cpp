// Runs a scene.
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

pfx::WorldDef worldDef(const SceneSpec& spec, const RunSettings& settings) {
  pfx::WorldDef def = spec.world;
  def.substeps = settings.substeps.value_or(def.substeps);
  def.workers = settings.threads;
  return def;
}

}  // namespace

SceneRun::SceneRun(const SceneSpec& spec, const RunSettings& settings)
    : spec_(spec), settings_(settings), world_(worldDef(spec, settings)), scene_(spec.make()) {
  scene_->build(world_);
}

void SceneRun::step() {
  scene_->beforeStep(world_, settings_.dt);
  world_.step(settings_.dt);
}

void SceneRun::stepTo(uint64_t steps) {
  while (world_.stepCount() < steps) step();
}

}  // namespace viewer
