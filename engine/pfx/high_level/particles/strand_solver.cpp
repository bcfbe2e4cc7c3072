#include "pfx/high_level/particles/strand_solver.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

// A thread that is drawn straight between two held ends has more links than ways to move along itself. This share of
// the diagonal keeps its system solvable; it damps the step by about as much.
constexpr float kHeldBothEnds = 1e-3f;
constexpr float kOtherwise = 1e-6f;

// Tension turns a light particle to and fro faster than a sub-step can follow when h^2 T / l exceeds its mass by more
// than this factor.
constexpr float kMaxTurn = 0.5f;
// Bound of the inertia that is lent to a particle, in its masses: a thread that no place can satisfy would ask for more
// and more.
constexpr float kMostLent = 1000.0f;

// A Newton step from links that are off by less than this share of their length leaves an error of its square. Where a
// whip turns them farther in one sub-step there are more steps, up to a bound.
constexpr float kFarOff = 0.03f;
constexpr int kMostSteps = 12;

}  // namespace

void StrandSolver::assign(std::span<const ParticleStrand> strands) {
  strands_.clear(), particle_.clear(), length_.clear(), impulse_.clear();
  for (const ParticleStrand& s : strands) {
    const auto count = static_cast<uint32_t>(s.particles.size());
    strands_.push_back({static_cast<uint32_t>(particle_.size()), count, s.compliance});
    particle_.insert(particle_.end(), s.particles.begin(), s.particles.end());
    length_.insert(length_.end(), s.lengths.begin(), s.lengths.end());
    impulse_.insert(impulse_.end(), s.impulses.begin(), s.impulses.end());
    length_.resize(particle_.size(), 1.0f), impulse_.resize(particle_.size(), 0.0f);
  }
  direction_.resize(particle_.size()), error_.resize(particle_.size());
  upper_.resize(particle_.size()), change_.resize(particle_.size());
  inverse_mass_.resize(particle_.size());
}

void StrandSolver::storeImpulses(std::span<ParticleStrand> strands) const {
  for (size_t s = 0; s < strands.size(); ++s)
    std::copy_n(impulse_.begin() + strands_[s].first, strands_[s].count - 1, strands[s].impulses.begin());
}

void StrandSolver::linearize(const Range& s, std::span<const Vec3> x) {
  for (uint32_t k = s.first; k + 1 < s.first + s.count; ++k) {
    const Vec3 d = x[particle_[k]] - x[particle_[k + 1]];
    const float length = d.norm();
    direction_[k] = d / (length > 0.0f ? length : 1.0f);
    error_[k] = length - length_[k];
  }
}

// A particle that carries much more than its own weight is given so much inertia that the directions of its links can
// be followed (geometric stiffness on the diagonal, after S. Andrews, M. Teichmann, P. Kry, Geometric Stiffness for
// Real-time Constrained Multibody Dynamics, 2017). What it carries is heavier still, so that the motion is the same.
void StrandSolver::weigh(const Range& s, const ParticleSpan& p) {
  float before = 0.0f;
  for (uint32_t k = s.first; k < s.first + s.count; ++k) {
    const float after = k + 1 < s.first + s.count ? std::abs(impulse_[k]) / length_[k] : 0.0f;
    const float w = p.inverse_mass[particle_[k]];
    inverse_mass_[k] = w / (1.0f + std::clamp(w * (before + after) - kMaxTurn, 0.0f, kMostLent));
    before = after;
  }
}

void StrandSolver::apply(const Range& s, const ParticleSpan& p, std::span<const float> impulse) const {
  Vec3 before = Vec3::Zero();
  for (uint32_t k = s.first; k + 1 < s.first + s.count; ++k) {
    const Vec3 pull = impulse[k] * direction_[k];
    p.position[particle_[k]] += inverse_mass_[k] * (pull - before);
    before = pull;
  }
  const uint32_t last = s.first + s.count - 1;
  p.position[particle_[last]] -= inverse_mass_[last] * before;
}

void StrandSolver::warmStart(uint32_t first, uint32_t last, const ParticleSpan& p, float share) {
  for (const Range& s : std::span(strands_).subspan(first, last - first)) {
    weigh(s, p);
    linearize(s, p.position);
    for (uint32_t k = s.first; k + 1 < s.first + s.count; ++k) impulse_[k] *= share;
    apply(s, p, impulse_);
  }
}

// Thomas algorithm: upper_ is the eliminated super-diagonal, change_ first the eliminated right side, then the result.
void StrandSolver::project(uint32_t first, uint32_t last, const ParticleSpan& p) {
  for (const Range& s : std::span(strands_).subspan(first, last - first)) {
    const float softness = s.compliance * p.inverse_h2;
    const uint32_t end = s.first + s.count - 1;
    const bool is_held = p.inverse_mass[particle_[s.first]] == 0.0f && p.inverse_mass[particle_[end]] == 0.0f;
    const float margin = 1.0f + (is_held ? kHeldBothEnds : kOtherwise);
    bool is_far = true;
    for (int step = 0; is_far && step < kMostSteps; ++step) {
      linearize(s, p.position);
      is_far = false;
      float below = 0.0f;  // coupling with the link before
      for (uint32_t k = s.first; k < end; ++k) {
        is_far = is_far || std::abs(error_[k]) > kFarOff * length_[k];
        const float w0 = inverse_mass_[k], w1 = inverse_mass_[k + 1];
        const float diagonal = (w0 + w1) * margin + softness;
        const float pivot = diagonal - (k > s.first ? below * upper_[k - 1] : 0.0f);
        const float inverse = pivot > 0.0f ? 1.0f / pivot : 0.0f;
        const float above = k + 1 < end ? -w1 * direction_[k].dot(direction_[k + 1]) : 0.0f;
        upper_[k] = above * inverse;
        const float right = -(error_[k] + softness * impulse_[k]);
        change_[k] = (right - (k > s.first ? below * change_[k - 1] : 0.0f)) * inverse;
        below = above;
      }
      for (uint32_t k = end - 1; k > s.first; --k) change_[k - 1] -= upper_[k - 1] * change_[k];
      for (uint32_t k = s.first; k < end; ++k) impulse_[k] += change_[k];
      apply(s, p, change_);
    }
  }
}

float StrandSolver::strain(uint32_t strand, std::span<const Vec3> x) const {
  const Range& s = strands_[strand];
  float worst = 0.0f;
  for (uint32_t k = s.first; k + 1 < s.first + s.count; ++k)
    worst = std::max(worst, std::abs((x[particle_[k]] - x[particle_[k + 1]]).norm() / length_[k] - 1.0f));
  return worst;
}

}  // namespace pfx
