#include "pfx/high_level/world/particle_store.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "pfx/high_level/world/world_impl.h"
#include "pfx/util/state_hash/state_hash.h"

namespace pfx {

ParticlesId ParticleStore::add(const ParticleDef& def, std::span<const RigidState> states) {
  auto system = std::make_unique<ParticleSystem>(def, states);
  const auto slot = static_cast<uint32_t>(std::find(systems.begin(), systems.end(), nullptr) - systems.begin());
  if (slot == systems.size()) systems.emplace_back(), generations.push_back(0);
  systems[slot] = std::move(system);
  ++count;
  return {slot, ++generations[slot]};
}

void ParticleStore::remove(uint32_t index) {
  systems[index].reset();
  ++generations[index];
  --count;
}

void ParticleStore::forgetBody(uint32_t body) {
  for (auto& system : systems)
    if (system) system->forgetBody(body);
}

uint64_t ParticleStore::hash(uint64_t of_bodies) const {
  uint64_t hash = of_bodies;
  for (const auto& system : systems) {
    if (!system) continue;
    const std::array<uint64_t, 2> both = {hash, system->stateHash()};
    hash = hashBytes(std::as_bytes(std::span(both)));
  }
  return hash;
}

ParticlesId World::addParticles(const ParticleDef& def) {
  for (const ParticleAnchor& a : def.anchors)
    if (a.body < impl_->store.states.size() && !impl_->store.exists(a.body))
      throw std::invalid_argument("particles \"" + def.name + "\": an anchor's body does not exist");
  return impl_->particle_store.add(def, impl_->store.states);
}

void World::removeParticles(ParticlesId id) {
  if (isValid(id)) impl_->particle_store.remove(id.index);
}

bool World::isValid(ParticlesId id) const { return impl_->particle_store.isValid(id); }
ParticlesId World::particlesId(uint32_t index) const { return {index, impl_->particle_store.generations.at(index)}; }
uint32_t World::numParticleSystems() const { return static_cast<uint32_t>(impl_->particle_store.systems.size()); }
const ParticleSystem* World::particles(uint32_t index) const { return impl_->particle_store.systems.at(index).get(); }

ParticleSystem& World::particles(ParticlesId id) {
  if (!isValid(id)) throw std::invalid_argument("world: the particle system does not exist");
  return *impl_->particle_store.systems[id.index];
}

}  // namespace pfx
