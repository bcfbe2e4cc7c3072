// A particle system as data: the particles, what holds them together, and all that the next step depends on.
//
// The same record describes a system that is to be made and one that runs, so that files and snapshots need no
// other. What the solver remembers is zero at first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace pfx {

// "As it stands": a rest value that is to be measured when the system is made.
inline constexpr float kAsItStands = -1.0f;

// A thread: neighbours keep their distance. All its links are solved together, so that its strain does not grow with
// its length or with what hangs on it.
struct ParticleStrand {
  std::vector<uint32_t> particles;  // at least two, each once
  std::vector<float> lengths = {};  // m, (n_particles - 1); empty: as they stand
  float compliance = 0.0f;          // m/N, of each link
  std::vector<float> impulses = {};  // (n_particles - 1) remembered, kg m; empty: zero
};

struct DistanceConstraint {
  uint32_t a = 0, b = 0;
  float length = kAsItStands;  // m
  float compliance = 0.0f;     // m/N
  float impulse = 0.0f;        // remembered, kg m
};

// The angle between the directions a -> b and b -> c. It is measured by its chord 2 sin(angle / 2), which is smooth at
// zero; for a straight rest shape this is the bending energy of a rod, quadratic in the curvature. A rod of bending
// stiffness EI with links of length l has compliance l / EI.
struct AngleConstraint {
  uint32_t a = 0, b = 0, c = 0;
  float length_ab = kAsItStands, length_bc = kAsItStands;  // m
  float chord = kAsItStands;                               // 0 .. 2; 0: straight
  float compliance = 0.0f;                                 // 1/(N m)
  float impulse = 0.0f;                                    // remembered, kg m^2
};

// Six times the volume of the tetrahedron is (b - a) x (c - a) . (d - a); it may be negative.
struct VolumeConstraint {
  uint32_t a = 0, b = 0, c = 0, d = 0;
  float volume = 0.0f;         // m^3; 0: as it stands
  float compliance = 0.0f;     // 1/(Pa m^3): 1 / (bulk modulus * volume) for an elastic solid
  float impulse = 0.0f;        // remembered, kg / m
};

// A particle that is part of a body. It follows the body exactly; a dynamic body feels what pulls at it.
struct ParticleAnchor {
  uint32_t particle = 0;
  uint32_t body = 0;         // index
  Vec3 local = Vec3::Zero();  // m, body frame
};

// May be changed between steps.
struct ParticleSettings {
  int substeps = 8;            // a step, >= 1
  int iterations = 2;          // rounds over all constraints in a sub-step, >= 1
  float warm_start = 0.3f;     // 0 .. 1, share of the last impulses that a sub-step starts from; 1 suits single threads only
  float radius = 0.02f;        // m, > 0: distance that particles keep from surfaces
  float friction = 0.5f;       // >= 0; against a body the geometric mean
  float damping = 0.0f;        // 1/s; velocity decays as exp(-damping t)
  float gravity_scale = 1.0f;
  uint32_t filter_self = 0xffffffffu;  // as for bodies
  uint32_t filter_target = 0xffffffffu;
};

// Names a particle system of a world; stays invalid after it was removed. Zero is null.
struct ParticlesId {
  uint32_t index = 0;
  uint32_t generation = 0;
  explicit operator bool() const { return generation != 0; }
  bool operator==(const ParticlesId&) const = default;
};

struct ParticleDef {
  std::string name = {};
  ParticleSettings settings = {};
  std::vector<Vec3> positions = {};   // m, world
  std::vector<Vec3> velocities = {};  // m/s; empty: at rest
  std::vector<float> masses = {};     // kg; 0: held in place
  std::vector<ParticleStrand> strands = {};
  std::vector<DistanceConstraint> distances = {};
  std::vector<AngleConstraint> angles = {};
  std::vector<VolumeConstraint> volumes = {};
  std::vector<ParticleAnchor> anchors = {};
};

}  // namespace pfx
