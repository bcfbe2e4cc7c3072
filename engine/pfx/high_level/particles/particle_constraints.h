// Constraints between two to four particles, projected one after the other.
//
// Each is moved towards its rest value along its gradient, with a compliance that makes its stiffness independent of
// step and iterations. Source: M. Macklin, M. Mueller, N. Chentanez, XPBD: Position-Based Simulation of Compliant
// Constrained Dynamics, MIG 2016; sub-steps instead of iterations: M. Macklin et al., Small Steps in Physics
// Simulation, SCA 2019.
#pragma once

#include <span>

#include "pfx/high_level/particles/particle_def.h"

namespace pfx {

// The particles that constraints move.
struct ParticleSpan {
  std::span<Vec3> position;          // m
  std::span<const float> inverse_mass;  // 1/kg; 0: held
  float inverse_h2;                  // 1/s^2, h: sub-step
};

// Applies `share` of the remembered impulses, and remembers that.
void warmStart(std::span<DistanceConstraint> constraints, const ParticleSpan& particles, float share);
void warmStart(std::span<AngleConstraint> constraints, const ParticleSpan& particles, float share);
void warmStart(std::span<VolumeConstraint> constraints, const ParticleSpan& particles, float share);

// One projection of each constraint.
void project(std::span<DistanceConstraint> constraints, const ParticleSpan& particles);
void project(std::span<AngleConstraint> constraints, const ParticleSpan& particles);
void project(std::span<VolumeConstraint> constraints, const ParticleSpan& particles);

// 2 sin(angle / 2) of an angle constraint where its particles are now.
float chord(const AngleConstraint& constraint, std::span<const Vec3> position);
float tetrahedronVolume(const VolumeConstraint& constraint, std::span<const Vec3> position);  // m^3

}  // namespace pfx
