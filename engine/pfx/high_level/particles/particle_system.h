// Particles held together by constraints and simulated on positions, in sub-steps, with two-way contact with bodies.
//
// A step, in each of its sub-steps: gravity and prediction, remembered impulses, volumes, angles, distances, contacts,
// strands; the velocity follows from what the positions were corrected. Strands come last, so that what two of them
// cannot both have shows as a share of the particles' radius in contacts and not as strain. See particle_constraints.h, strand_solver.h and
// particle_contacts.h for the sources. Constraints are coloured when the system is made, and solved colour by colour,
// so that results do not depend on the number of workers. A step allocates nothing once its contacts have grown.
#pragma once

#include <span>
#include <vector>

#include "pfx/high_level/particles/particle_contacts.h"
#include "pfx/high_level/particles/particle_def.h"
#include "pfx/high_level/particles/strand_solver.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct ParticleStepInput {
  ParticleSurroundings around;
  Vec3 gravity = Vec3::Zero();  // m/s^2
  float dt = 0.0f;              // s, > 0
};

class ParticleSystem {
 public:
  // Anchored particles are put where their bodies are. Throws std::invalid_argument, naming the system and what is
  // wrong: arrays of different length, values that are not finite or out of range, indices that do not exist,
  // particles of one constraint that coincide, an anchor on a body that does not exist.
  ParticleSystem(const ParticleDef& def, std::span<const RigidState> states);

  // Advances the particles by the step that the bodies have just made, and pushes the bodies that they touch.
  void step(const ParticleStepInput& input, TaskManager& tasks);

  // Bodies that slept through more than this speed (m/s) in the last step. Valid until the next call.
  std::span<const uint32_t> disturbedSleepers(float speed);

  // Everything that the next step depends on. A system made of it continues to the bit.
  ParticleDef def() const;

  const std::string& name() const { return def_.name; }
  std::span<const Vec3> positions() const { return def_.positions; }    // m, world
  std::span<const Vec3> velocities() const { return def_.velocities; }  // m/s
  std::span<const float> masses() const { return def_.masses; }         // kg
  std::span<const ParticleAnchor> anchors() const { return def_.anchors; }
  std::span<const ParticleStrand> strands() const { return def_.strands; }
  std::span<const DistanceConstraint> distances() const { return def_.distances; }
  std::span<const AngleConstraint> angles() const { return def_.angles; }
  std::span<const VolumeConstraint> volumes() const { return def_.volumes; }

  // Between steps. setSettings throws as the constructor does.
  const ParticleSettings& settings() const { return def_.settings; }
  void setSettings(const ParticleSettings& settings);
  void setVelocity(uint32_t particle, const Vec3& velocity);
  void hold(uint32_t particle, const Vec3& position);  // held in place from now on
  void release(uint32_t particle, float mass);         // kg; no longer held or anchored
  void forgetBody(uint32_t body);                      // its anchored particles have their own mass from now on

  // Largest |length / rest length - 1| of all strands and of distances without compliance.
  float maxStrain() const;
  // Total volume of the volume constraints, relative to rest; 1 when there is none.
  float relativeVolume() const;
  Vec3 momentum() const;  // kg m/s, of particles that are not held
  uint64_t stateHash() const;  // of positions and velocities, bit-exact

 private:
  void beginStep(const ParticleStepInput& input);
  void predict(const ParticleStepInput& input, float h);
  void placeAnchored(std::span<const RigidState> states);
  void solveConstraints(bool warm_start, const ParticleSpan& particles, TaskManager& tasks);
  void solveStrands(const ParticleSpan& particles, TaskManager& tasks);
  void pullBodies(float h);
  void updateVelocities(float h);

  ParticleDef def_;
  StrandSolver strands_;
  std::vector<uint32_t> strand_colours_, distance_colours_, angle_colours_, volume_colours_;
  std::vector<uint8_t> anchored_;    // by particle
  std::vector<float> inverse_mass_;  // 1/kg, by particle
  // Of a step.
  std::vector<Vec3> previous_, predicted_;  // m, before and after the flight of a sub-step
  std::vector<ParticleBody> bodies_;
  std::vector<uint32_t> anchor_body_;  // by anchor: in bodies_
  std::vector<Vec3> anchor_place_;     // m, by anchor: before constraints pull at it
  std::vector<uint32_t> disturbed_;
  ParticleContacts contacts_;
};

}  // namespace pfx
