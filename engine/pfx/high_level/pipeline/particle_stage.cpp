// Particles of a world: they follow the bodies through the step that those have made.
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {

void moveParticles(World::Impl& w) {
  for (auto& system : w.particle_store.systems) {
    if (!system) continue;
    system->step({.around = {.states = w.store.states,
                             .bodies = w.store.bodies,
                             .inertias = w.store.inertias,
                             .collidables = w.store.collidables,
                             .start_poses = w.particle_store.start_poses},
                  .gravity = w.def.gravity,
                  .dt = w.dt},
                 w.tasks);
    for (const uint32_t body : system->disturbedSleepers(w.def.sleep_velocity)) w.wake(body);
  }
  w.revivePairs();
  w.tree_is_current = false;
}

}  // namespace pfx::stage
