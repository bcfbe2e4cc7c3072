#include "pfx/high_level/particles/particle_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/particles/particle_check.h"
#include "pfx/high_level/particles/particle_colouring.h"
#include "pfx/util/state_hash/state_hash.h"

namespace pfx {
namespace {

constexpr uint32_t kStrandGrain = 4, kConstraintGrain = 128;

// Calls fn(begin, end) for the items of one colour after the other, shared out over the workers.
template <class Fn>
void forColours(std::span<const uint32_t> colours, uint32_t grain, TaskManager& tasks, Fn&& fn) {
  for (size_t c = 0; c + 1 < colours.size(); ++c) {
    const uint32_t first = colours[c];
    tasks.parallelFor(colours[c + 1] - first, grain, [&](TaskRange r) { fn(first + r.begin, first + r.end); });
  }
}

template <class Constraint>
std::span<Constraint> range(std::vector<Constraint>& constraints, uint32_t begin, uint32_t end) {
  return std::span(constraints).subspan(begin, end - begin);
}

}  // namespace

ParticleSystem::ParticleSystem(const ParticleDef& def, std::span<const RigidState> states) : def_(def) {
  checkParticles(def_, states.size());
  placeAnchored(states);
  measureRest(def_);
  const size_t n = def_.positions.size();
  strand_colours_ = sortByColour(def_.strands, n, [](const ParticleStrand& s) { return std::span(s.particles); });
  distance_colours_ = sortByColour(def_.distances, n, [](const auto& c) { return std::array{c.a, c.b}; });
  angle_colours_ = sortByColour(def_.angles, n, [](const auto& c) { return std::array{c.a, c.b, c.c}; });
  volume_colours_ = sortByColour(def_.volumes, n, [](const auto& c) { return std::array{c.a, c.b, c.c, c.d}; });
  strands_.assign(def_.strands);
  anchored_.assign(n, 0);
  inverse_mass_.assign(n, 0.0f);
  previous_ = predicted_ = def_.positions;
  for (const ParticleAnchor& a : def_.anchors) anchored_[a.particle] = 1;
  for (size_t i = 0; i < n; ++i)
    if (!anchored_[i] && def_.masses[i] > 0.0f) inverse_mass_[i] = 1.0f / def_.masses[i];
}

ParticleDef ParticleSystem::def() const {
  ParticleDef current = def_;
  strands_.storeImpulses(current.strands);
  return current;
}

void ParticleSystem::placeAnchored(std::span<const RigidState> states) {
  for (const ParticleAnchor& a : def_.anchors)
    def_.positions[a.particle] = states[a.body].pose().apply(a.local);
}

// The bodies that have an anchor come first. Each of several anchors of a body is given its share of the mass.
void ParticleSystem::beginStep(const ParticleStepInput& input) {
  bodies_.clear(), anchor_body_.clear();
  for (const ParticleAnchor& a : def_.anchors) {
    uint32_t k = 0;
    while (k < bodies_.size() && bodies_[k].body != a.body) ++k;
    if (k == bodies_.size()) bodies_.emplace_back(input.around, a.body);
    anchor_body_.push_back(k);
  }
  for (size_t i = 0; i < def_.anchors.size(); ++i) {
    const auto share = static_cast<float>(std::count(anchor_body_.begin(), anchor_body_.end(), anchor_body_[i]));
    const ParticleBody& body = bodies_[anchor_body_[i]];
    inverse_mass_[def_.anchors[i].particle] = share * body.inverseMass(body.now.apply(def_.anchors[i].local));
  }
  contacts_.find({.around = input.around,
                  .settings = def_.settings,
                  .position = def_.positions,
                  .velocity = def_.velocities,
                  .anchored = anchored_,
                  .gravity = input.gravity,
                  .dt = input.dt},
                 bodies_);
}

void ParticleSystem::predict(const ParticleStepInput& input, float h) {
  const float decay = def_.settings.damping > 0.0f ? exp(-def_.settings.damping * h) : 1.0f;
  const Vec3 fall = h * def_.settings.gravity_scale * input.gravity;
  for (size_t i = 0; i < def_.positions.size(); ++i) {
    previous_[i] = def_.positions[i];
    Vec3& v = def_.velocities[i];
    v = inverse_mass_[i] > 0.0f ? Vec3(decay * (v + fall)) : Vec3(Vec3::Zero());
    def_.positions[i] += h * v;
    predicted_[i] = def_.positions[i];
  }
  anchor_place_.clear();
  for (size_t i = 0; i < def_.anchors.size(); ++i) {
    anchor_place_.push_back(bodies_[anchor_body_[i]].now.apply(def_.anchors[i].local));
    def_.positions[def_.anchors[i].particle] = anchor_place_.back();
  }
}

void ParticleSystem::solveConstraints(bool warm_start, const ParticleSpan& p, TaskManager& tasks) {
  const float share = def_.settings.warm_start;
  forColours(strand_colours_, kStrandGrain, tasks, [&](uint32_t begin, uint32_t end) {
    if (warm_start) strands_.warmStart(begin, end, p, share);
  });
  const auto all = [&](auto& constraints, std::span<const uint32_t> colours, bool warm) {
    forColours(colours, kConstraintGrain, tasks, [&](uint32_t begin, uint32_t end) {
      if (warm)
        pfx::warmStart(range(constraints, begin, end), p, share);
      else
        pfx::project(range(constraints, begin, end), p);
    });
  };
  if (warm_start) {
    all(def_.distances, distance_colours_, true);
    all(def_.angles, angle_colours_, true);
    all(def_.volumes, volume_colours_, true);
  }
  all(def_.volumes, volume_colours_, false);
  all(def_.angles, angle_colours_, false);
  all(def_.distances, distance_colours_, false);
}

void ParticleSystem::solveStrands(const ParticleSpan& p, TaskManager& tasks) {
  forColours(strand_colours_, kStrandGrain, tasks,
             [&](uint32_t begin, uint32_t end) { strands_.project(begin, end, p); });
}

// What the constraints have moved an anchored particle is the impulse on its body.
void ParticleSystem::pullBodies(float h) {
  for (size_t i = 0; i < def_.anchors.size(); ++i) {
    const uint32_t particle = def_.anchors[i].particle;
    ParticleBody& body = bodies_[anchor_body_[i]];
    if (inverse_mass_[particle] == 0.0f) continue;
    body.push((def_.positions[particle] - anchor_place_[i]) / inverse_mass_[particle], anchor_place_[i], h);
  }
}

// What was not corrected keeps its velocity to the bit; a difference of positions would lose it in rounding.
void ParticleSystem::updateVelocities(float h) {
  const float inverse_h = 1.0f / h;
  for (size_t i = 0; i < def_.positions.size(); ++i)
    def_.velocities[i] += inverse_h * (def_.positions[i] - predicted_[i]);
  for (const ParticleAnchor& a : def_.anchors)
    def_.velocities[a.particle] = inverse_h * (def_.positions[a.particle] - previous_[a.particle]);
}

void ParticleSystem::step(const ParticleStepInput& input, TaskManager& tasks) {
  const ParticleSettings& s = def_.settings;
  const float h = input.dt / static_cast<float>(s.substeps);
  if (!(h > 0.0f)) return;
  beginStep(input);
  const ParticleSpan particles{def_.positions, inverse_mass_, 1.0f / (h * h)};
  for (int k = 0; k < s.substeps; ++k) {
    for (ParticleBody& b : bodies_) b.advance(k, s.substeps, h);
    predict(input, h);
    for (int i = 0; i < s.iterations; ++i) {
      solveConstraints(i == 0, particles, tasks);
      contacts_.solve({input.around, s, particles, previous_, h}, bodies_, tasks);
      solveStrands(particles, tasks);
    }
    pullBodies(h);
    updateVelocities(h);
  }
  for (const ParticleBody& b : bodies_) b.finish(input.around.states[b.body]);
  placeAnchored(input.around.states);
}

std::span<const uint32_t> ParticleSystem::disturbedSleepers(float speed) {
  disturbed_.clear();
  for (const ParticleBody& b : bodies_)
    if (b.sleptThrough() > speed) disturbed_.push_back(b.body);
  return disturbed_;
}

void ParticleSystem::forgetBody(uint32_t body) {
  std::erase_if(def_.anchors, [&](const ParticleAnchor& a) {
    if (a.body != body) return false;
    const float mass = def_.masses[a.particle];
    anchored_[a.particle] = 0;
    inverse_mass_[a.particle] = mass > 0.0f ? 1.0f / mass : 0.0f;
    return true;
  });
}

void ParticleSystem::setSettings(const ParticleSettings& settings) {
  checkSettings(settings, def_.name);
  def_.settings = settings;
}

void ParticleSystem::setVelocity(uint32_t particle, const Vec3& velocity) {
  if (!velocity.allFinite()) throw std::invalid_argument("particles \"" + def_.name + "\": velocity is not finite");
  def_.velocities.at(particle) = velocity;
}

void ParticleSystem::hold(uint32_t particle, const Vec3& position) {
  if (!position.allFinite()) throw std::invalid_argument("particles \"" + def_.name + "\": position is not finite");
  def_.positions.at(particle) = position;
  def_.masses[particle] = inverse_mass_[particle] = 0.0f;
}

void ParticleSystem::release(uint32_t particle, float mass) {
  if (!(mass > 0.0f) || !std::isfinite(mass))
    throw std::invalid_argument("particles \"" + def_.name + "\": mass must be > 0");
  def_.masses.at(particle) = mass;
  inverse_mass_[particle] = 1.0f / mass;
  anchored_[particle] = 0;
  std::erase_if(def_.anchors, [&](const ParticleAnchor& a) { return a.particle == particle; });
}

float ParticleSystem::maxStrain() const {
  float worst = 0.0f;
  for (uint32_t i = 0; i < def_.strands.size(); ++i) worst = std::max(worst, strands_.strain(i, def_.positions));
  for (const DistanceConstraint& c : def_.distances) {
    if (c.compliance > 0.0f) continue;
    const float length = (def_.positions[c.a] - def_.positions[c.b]).norm();
    worst = std::max(worst, std::abs(length / c.length - 1.0f));
  }
  return worst;
}

float ParticleSystem::relativeVolume() const {
  double now = 0.0, rest = 0.0;
  for (const VolumeConstraint& c : def_.volumes) {
    now += tetrahedronVolume(c, def_.positions);
    rest += c.volume;
  }
  return rest == 0.0 ? 1.0f : static_cast<float>(now / rest);
}

Vec3 ParticleSystem::momentum() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < def_.positions.size(); ++i)
    if (!anchored_[i]) sum += static_cast<double>(def_.masses[i]) * def_.velocities[i].cast<double>();
  return sum.cast<float>();
}

uint64_t ParticleSystem::stateHash() const {
  const std::array<uint64_t, 2> both = {hashBytes(std::as_bytes(std::span(def_.positions))),
                                        hashBytes(std::as_bytes(std::span(def_.velocities)))};
  return hashBytes(std::as_bytes(std::span(both)));
}

}  // namespace pfx
