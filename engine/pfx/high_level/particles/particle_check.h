// Whether a particle system makes sense, and the rest values that it leaves to be measured.
#pragma once

#include "pfx/high_level/particles/particle_def.h"

namespace pfx {

// Throws std::invalid_argument, naming the system and what is wrong.
void checkSettings(const ParticleSettings& settings, const std::string& name);
// `num_bodies`: bodies that anchors may name.
void checkParticles(const ParticleDef& def, size_t num_bodies);

// Replaces kAsItStands and empty lists by what the positions say. Throws when particles of one constraint coincide.
void measureRest(ParticleDef& def);

}  // namespace pfx
