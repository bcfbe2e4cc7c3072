// Strands: all links of a thread are solved at once.
//
// The links of a chain couple only with their neighbours, so that the system of all of them is tridiagonal and costs
// as much as one round of projections. One Newton step per sub-step keeps a chain inextensible whatever its length and
// whatever hangs on it, where projections one by one would leave it stretched in proportion to both.
// Source: R. Goldenthal et al., Efficient Simulation of Inextensible Cloth, SIGGRAPH 2007 (fast projection).
#pragma once

#include <span>
#include <vector>

#include "pfx/high_level/particles/particle_constraints.h"

namespace pfx {

// The strands of a system in dense arrays. Entry k of the link arrays is the link from strand particle k to k + 1.
class StrandSolver {
 public:
  void assign(std::span<const ParticleStrand> strands);
  void storeImpulses(std::span<ParticleStrand> strands) const;  // those of assign()

  // Strands first .. last - 1; they must share no particle. A sub-step starts with warmStart().
  void warmStart(uint32_t first, uint32_t last, const ParticleSpan& particles, float share);
  void project(uint32_t first, uint32_t last, const ParticleSpan& particles);

  // Largest |length / rest length - 1| of a strand.
  float strain(uint32_t strand, std::span<const Vec3> position) const;

 private:
  struct Range {
    uint32_t first, count;  // particles
    float compliance;
  };
  void weigh(const Range& strand, const ParticleSpan& particles);
  void linearize(const Range& strand, std::span<const Vec3> position);
  void apply(const Range& strand, const ParticleSpan& particles, std::span<const float> impulse) const;

  std::vector<Range> strands_;
  std::vector<uint32_t> particle_;
  std::vector<float> length_, impulse_;
  // Scratch of a projection, by link.
  std::vector<Vec3> direction_;
  std::vector<float> error_, upper_, change_;
  std::vector<float> inverse_mass_;  // 1/kg, by strand particle, as the sub-step takes it to be
};

}  // namespace pfx
