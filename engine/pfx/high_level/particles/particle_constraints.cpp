#include "pfx/high_level/particles/particle_constraints.h"

#include <array>
#include <cmath>

namespace pfx {
namespace {

// Value and gradient of a constraint of N particles.
template <size_t N>
struct Linear {
  std::array<uint32_t, N> particle;
  std::array<Vec3, N> gradient;
  float error;    // value minus rest value
  bool is_valid;  // the gradient exists
};

Linear<2> linearize(const DistanceConstraint& c, std::span<const Vec3> x) {
  const Vec3 d = x[c.a] - x[c.b];
  const float length = d.norm();
  const Vec3 n = d / (length > 0.0f ? length : 1.0f);
  return {{c.a, c.b}, {n, -n}, length - c.length, length > 0.0f};
}

Linear<3> linearize(const AngleConstraint& c, std::span<const Vec3> x) {
  const float p = 1.0f / c.length_ab, q = 1.0f / c.length_bc;
  const Vec3 turn = q * (x[c.c] - x[c.b]) - p * (x[c.b] - x[c.a]);
  const float size = turn.norm();
  const Vec3 n = turn / (size > 0.0f ? size : 1.0f);
  return {{c.a, c.b, c.c}, {p * n, -(p + q) * n, q * n}, size - c.chord, size > 0.0f};
}

Linear<4> linearize(const VolumeConstraint& c, std::span<const Vec3> x) {
  const Vec3 u = x[c.b] - x[c.a], v = x[c.c] - x[c.a], w = x[c.d] - x[c.a];
  const Vec3 gb = v.cross(w) / 6.0f, gc = w.cross(u) / 6.0f, gd = u.cross(v) / 6.0f;
  return {{c.a, c.b, c.c, c.d}, {-(gb + gc + gd), gb, gc, gd}, gd.dot(w) - c.volume, true};
}

template <size_t N>
void apply(const Linear<N>& l, const ParticleSpan& p, float impulse) {
  for (size_t k = 0; k < N; ++k)
    p.position[l.particle[k]] += (impulse * p.inverse_mass[l.particle[k]]) * l.gradient[k];
}

template <class Constraint>
void warmStartAll(std::span<Constraint> constraints, const ParticleSpan& p, float share) {
  for (Constraint& c : constraints) {
    const auto l = linearize(c, p.position);
    c.impulse = l.is_valid ? share * c.impulse : 0.0f;
    apply(l, p, c.impulse);
  }
}

template <class Constraint>
void projectAll(std::span<Constraint> constraints, const ParticleSpan& p) {
  for (Constraint& c : constraints) {
    const auto l = linearize(c, p.position);
    const float softness = c.compliance * p.inverse_h2;
    float resistance = softness;
    for (size_t k = 0; k < l.particle.size(); ++k)
      resistance += p.inverse_mass[l.particle[k]] * l.gradient[k].squaredNorm();
    if (!l.is_valid || !(resistance > 0.0f)) continue;
    const float change = -(l.error + softness * c.impulse) / resistance;
    c.impulse += change;
    apply(l, p, change);
  }
}

}  // namespace

void warmStart(std::span<DistanceConstraint> c, const ParticleSpan& p, float share) { warmStartAll(c, p, share); }
void warmStart(std::span<AngleConstraint> c, const ParticleSpan& p, float share) { warmStartAll(c, p, share); }
void warmStart(std::span<VolumeConstraint> c, const ParticleSpan& p, float share) { warmStartAll(c, p, share); }

void project(std::span<DistanceConstraint> c, const ParticleSpan& p) { projectAll(c, p); }
void project(std::span<AngleConstraint> c, const ParticleSpan& p) { projectAll(c, p); }
void project(std::span<VolumeConstraint> c, const ParticleSpan& p) { projectAll(c, p); }

float chord(const AngleConstraint& c, std::span<const Vec3> x) {
  return ((x[c.c] - x[c.b]) / c.length_bc - (x[c.b] - x[c.a]) / c.length_ab).norm();
}

float tetrahedronVolume(const VolumeConstraint& c, std::span<const Vec3> x) {
  return (x[c.b] - x[c.a]).cross(x[c.c] - x[c.a]).dot(x[c.d] - x[c.a]) / 6.0f;
}

}  // namespace pfx
