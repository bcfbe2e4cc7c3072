#include "pfx/high_level/particles/particle_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pfx/high_level/particles/particle_constraints.h"

namespace pfx {
namespace {

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw std::invalid_argument("particles \"" + name + "\": " + what);
}

void require(bool condition, const std::string& name, const std::string& what) {
  if (!condition) reject(name, what);
}

bool isPositive(float x) { return x > 0.0f && std::isfinite(x); }
bool isNotNegative(float x) { return x >= 0.0f && std::isfinite(x); }
bool isLength(float x) { return x == kAsItStands || isPositive(x); }

std::string place(const char* what, size_t index) { return std::string(what) + " " + std::to_string(index); }

// Particles of one constraint, which exist and differ.
void checkIndices(const ParticleDef& def, std::vector<uint32_t> particles, const std::string& where) {
  for (const uint32_t p : particles)
    require(p < def.positions.size(), def.name, where + ": particle " + std::to_string(p) + " does not exist");
  std::sort(particles.begin(), particles.end());
  require(std::adjacent_find(particles.begin(), particles.end()) == particles.end(), def.name,
          where + ": a particle occurs twice");
}

void checkValues(const ParticleDef& def, float compliance, float impulse, const std::string& where) {
  require(isNotNegative(compliance), def.name, where + ": compliance must be >= 0");
  require(std::isfinite(impulse), def.name, where + ": impulse is not finite");
}

void checkStrands(const ParticleDef& def) {
  for (size_t i = 0; i < def.strands.size(); ++i) {
    const ParticleStrand& s = def.strands[i];
    const std::string where = place("strand", i);
    require(s.particles.size() >= 2, def.name, where + ": has fewer than two particles");
    checkIndices(def, s.particles, where);
    const size_t links = s.particles.size() - 1;
    require(s.lengths.empty() || s.lengths.size() == links, def.name, where + ": the number of lengths is wrong");
    require(s.impulses.empty() || s.impulses.size() == links, def.name, where + ": the number of impulses is wrong");
    require(std::all_of(s.lengths.begin(), s.lengths.end(), isPositive), def.name, where + ": lengths must be > 0");
    checkValues(def, s.compliance, 0.0f, where);
    for (const float impulse : s.impulses) checkValues(def, 0.0f, impulse, where);
  }
}

void checkConstraints(const ParticleDef& def) {
  for (size_t i = 0; i < def.distances.size(); ++i) {
    const DistanceConstraint& c = def.distances[i];
    checkIndices(def, {c.a, c.b}, place("distance", i));
    require(isLength(c.length), def.name, place("distance", i) + ": length must be > 0");
    checkValues(def, c.compliance, c.impulse, place("distance", i));
  }
  for (size_t i = 0; i < def.angles.size(); ++i) {
    const AngleConstraint& c = def.angles[i];
    checkIndices(def, {c.a, c.b, c.c}, place("angle", i));
    require(isLength(c.length_ab) && isLength(c.length_bc), def.name, place("angle", i) + ": lengths must be > 0");
    require(c.chord == kAsItStands || (c.chord >= 0.0f && c.chord <= 2.0f), def.name,
            place("angle", i) + ": chord must be 0 .. 2");
    checkValues(def, c.compliance, c.impulse, place("angle", i));
  }
  for (size_t i = 0; i < def.volumes.size(); ++i) {
    const VolumeConstraint& c = def.volumes[i];
    checkIndices(def, {c.a, c.b, c.c, c.d}, place("volume", i));
    require(std::isfinite(c.volume), def.name, place("volume", i) + ": volume is not finite");
    checkValues(def, c.compliance, c.impulse, place("volume", i));
  }
}

// A length that was not given, or the one that was.
float measured(float length, const Vec3& a, const Vec3& b, const std::string& name, const std::string& where) {
  if (length != kAsItStands) return length;
  const float distance = (a - b).norm();
  require(distance > 0.0f, name, where + ": two particles coincide");
  return distance;
}

}  // namespace

void checkSettings(const ParticleSettings& s, const std::string& name) {
  require(s.substeps >= 1, name, "substeps must be >= 1");
  require(s.iterations >= 1, name, "iterations must be >= 1");
  require(s.warm_start >= 0.0f && s.warm_start <= 1.0f, name, "warm_start must be 0 .. 1");
  require(isPositive(s.radius), name, "radius must be > 0");
  require(isNotNegative(s.friction), name, "friction must be >= 0");
  require(isNotNegative(s.damping), name, "damping must be >= 0");
  require(std::isfinite(s.gravity_scale), name, "gravity_scale is not finite");
}

void checkParticles(const ParticleDef& def, size_t num_bodies) {
  const size_t n = def.positions.size();
  checkSettings(def.settings, def.name);
  require(n > 0, def.name, "there is no particle");
  require(def.masses.size() == n, def.name, "the number of masses is not that of the positions");
  require(def.velocities.empty() || def.velocities.size() == n, def.name,
          "the number of velocities is not that of the positions");
  for (size_t i = 0; i < n; ++i) {
    require(def.positions[i].allFinite(), def.name, place("position", i) + " is not finite");
    require(isNotNegative(def.masses[i]), def.name, place("mass", i) + " must be >= 0");
  }
  for (size_t i = 0; i < def.velocities.size(); ++i)
    require(def.velocities[i].allFinite(), def.name, place("velocity", i) + " is not finite");
  checkStrands(def);
  checkConstraints(def);
  for (size_t i = 0; i < def.anchors.size(); ++i) {
    const ParticleAnchor& a = def.anchors[i];
    require(a.particle < n, def.name, place("anchor", i) + ": the particle does not exist");
    require(a.body < num_bodies, def.name, place("anchor", i) + ": the body does not exist");
    require(a.local.allFinite(), def.name, place("anchor", i) + ": the point is not finite");
  }
}

void measureRest(ParticleDef& def) {
  const auto& x = def.positions;
  def.velocities.resize(x.size(), Vec3::Zero());
  for (size_t i = 0; i < def.strands.size(); ++i) {
    ParticleStrand& s = def.strands[i];
    s.lengths.resize(s.particles.size() - 1, kAsItStands);
    s.impulses.resize(s.particles.size() - 1, 0.0f);
    for (size_t k = 0; k < s.lengths.size(); ++k)
      s.lengths[k] = measured(s.lengths[k], x[s.particles[k]], x[s.particles[k + 1]], def.name, place("strand", i));
  }
  for (size_t i = 0; i < def.distances.size(); ++i) {
    DistanceConstraint& c = def.distances[i];
    c.length = measured(c.length, x[c.a], x[c.b], def.name, place("distance", i));
  }
  for (size_t i = 0; i < def.angles.size(); ++i) {
    AngleConstraint& c = def.angles[i];
    c.length_ab = measured(c.length_ab, x[c.a], x[c.b], def.name, place("angle", i));
    c.length_bc = measured(c.length_bc, x[c.b], x[c.c], def.name, place("angle", i));
    if (c.chord == kAsItStands) c.chord = chord(c, x);
  }
  for (size_t i = 0; i < def.volumes.size(); ++i) {
    VolumeConstraint& c = def.volumes[i];
    if (c.volume == 0.0f) c.volume = tetrahedronVolume(c, x);
    require(c.volume != 0.0f, def.name, place("volume", i) + ": the tetrahedron is flat");
  }
}

}  // namespace pfx
