// Contacts of particles with the shapes of bodies.
//
// Once a step the particles near each shape are listed; in each sub-step they are held against the shape where it is
// then, and pushed out along its surface normal with Coulomb friction. A particle that crosses a whole shape within a
// sub-step is found by the ray that it went along.
// Source of friction on positions: M. Macklin et al., Unified Particle Physics for Real-Time Applications, SIGGRAPH
// 2014, section 6.1.
#pragma once

#include <span>
#include <vector>

#include "pfx/high_level/particles/particle_bodies.h"
#include "pfx/high_level/particles/particle_constraints.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

class ParticleContacts {
 public:
  // Lists what may touch within a step of dt seconds under `gravity` (m/s^2). `anchored`: by particle, nonzero for
  // those that belong to a body. Bodies with an anchor are in `bodies` already; others are appended.
  struct FindInput {
    const ParticleSurroundings& around;
    const ParticleSettings& settings;
    std::span<const Vec3> position, velocity;
    std::span<const uint8_t> anchored;
    Vec3 gravity;
    float dt;
  };
  void find(const FindInput& input, std::vector<ParticleBody>& bodies);

  // Pushes the particles of all listed contacts out. `previous`: where they were at the start of the sub-step of h
  // seconds. The result does not depend on the number of workers.
  struct SolveInput {
    const ParticleSurroundings& around;
    const ParticleSettings& settings;
    ParticleSpan particles;
    std::span<const Vec3> previous;
    float h;
  };
  void solve(const SolveInput& input, std::span<ParticleBody> bodies, TaskManager& tasks);

  size_t size() const { return near_.size(); }

 private:
  // The particles near one shape.
  struct Group {
    uint32_t body, shape;   // in the list of bodies; in its collidable
    uint32_t first, count;  // in near_
  };
  struct Block {
    Aabb bounds;  // m, of the way of its particles
  };
  void boundBlocks(const FindInput& input);
  void listNear(const Aabb& box, const FindInput& input);

  std::vector<Group> groups_;
  std::vector<uint32_t> near_;  // particles
  std::vector<Block> blocks_;
  std::vector<Aabb> ways_;  // by particle
  Aabb bounds_;
};

}  // namespace pfx
