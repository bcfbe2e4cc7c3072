// The step as a table: named stages that run in order, each timed, none called when it has nothing to do.
#pragma once

#include <span>

#include "pfx/high_level/world/world.h"

namespace pfx {

struct Stage {
  const char* name;
  bool (*needed)(const World::Impl&);  // whether this world has anything for the stage
  void (*run)(World::Impl&);
};

// The stages of a pipeline in order.
std::span<const Stage> stages(Pipeline pipeline);

// Runs them all and records the times.
void runStages(World::Impl& world);

}  // namespace pfx
