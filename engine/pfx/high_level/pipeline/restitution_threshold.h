// Which impacts are too slow to bounce.
#pragma once

#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {

// m/s. What rests falls a little in each step and must not bounce off; without weight everything does.
float restitutionThreshold(const World::Impl& world);

}  // namespace pfx::stage
