// The particle systems of a world, with handles that notice removal.
#pragma once

#include <memory>

#include "pfx/base_level/memory/containers.h"
#include "pfx/high_level/particles/particle_system.h"

namespace pfx {

struct ParticleStore {
  Vector<std::unique_ptr<ParticleSystem>> systems;  // null when removed
  Vector<uint32_t> generations;                     // odd while the system exists
  Vector<Transform> start_poses;                    // by body, before the step; while there is a system

  bool empty() const { return count == 0; }
  uint32_t count = 0;  // of systems that exist

  // Throws std::invalid_argument naming the system.
  ParticlesId add(const ParticleDef& def, std::span<const RigidState> states);
  void remove(uint32_t index);
  bool isValid(ParticlesId id) const {
    return id && id.index < generations.size() && generations[id.index] == id.generation;
  }
  void forgetBody(uint32_t body);
  uint64_t hash(uint64_t of_bodies) const;  // of both together
};

}  // namespace pfx
