#include "samples/9_particle_physics/particle_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pfx/high_level/particles/particle_builder.h"

namespace samples {

using namespace pfx;

namespace {

// Turn that takes the x axis to a unit vector.
Quat turnFromX(const Vec3& direction) {
  const Vec3 axis = Vec3::UnitX().cross(direction);
  const Quat twice(1.0f + direction.x(), axis.x(), axis.y(), axis.z());
  return direction.x() > -0.9999f ? Quat(twice.normalized()) : Quat(0.0f, 0.0f, 1.0f, 0.0f);
}

float strainOf(const ParticleSystem& p, const ParticleStrand& s, size_t link) {
  return (p.positions()[s.particles[link]] - p.positions()[s.particles[link + 1]]).norm() / s.lengths[link] - 1.0f;
}

uint32_t blend(float a, float b, float t) { return static_cast<uint32_t>(a + t * (b - a)); }

// Normals of a sheet, for lifting its threads off it.
std::vector<Vec3> normalsOf(const ParticleSystem& p, const SheetView& v) {
  std::vector<Vec3> out;
  const auto at = [&](int r, int c) {
    r = std::clamp(r, 0, v.rows - 1), c = std::clamp(c, 0, v.columns - 1);
    return p.positions()[v.first + static_cast<uint32_t>(r * v.columns + c)];
  };
  for (int r = 0; r < v.rows; ++r)
    for (int c = 0; c < v.columns; ++c)
      out.push_back((at(r + 1, c) - at(r - 1, c)).cross(at(r, c + 1) - at(r, c - 1)).normalized());
  return out;
}

}  // namespace

Color heatColor(float heat) {
  constexpr std::array<std::array<float, 3>, 4> kStops = {{{30, 80, 190}, {30, 150, 90}, {230, 170, 30}, {210, 40, 30}}};
  const float t = 3.0f * std::clamp(heat, 0.0f, 1.0f);
  const auto k = std::min(static_cast<size_t>(t), size_t(2));
  const float f = t - static_cast<float>(k);
  const auto channel = [&](size_t i) { return blend(kStops[k][i], kStops[k + 1][i], f); };
  return 0xff000000u | channel(0) << 16 | channel(1) << 8 | channel(2);
}

void drawSheet(const ParticleSystem& p, const SheetView& v, Canvas& canvas) {
  const std::vector<uint32_t> triangles = clothTriangles(v.columns, v.rows, v.first);
  canvas.surface({.points = p.positions(), .indices = triangles, .two_sided = true}, v.paint);
  if (!v.strain) return;
  constexpr float kLift = 0.006f;  // m
  const std::vector<Vec3> normals = normalsOf(p, v);
  const auto end = v.first + static_cast<uint32_t>(v.columns * v.rows);
  for (const ParticleStrand& s : p.strands()) {
    if (s.particles.front() < v.first || s.particles.front() >= end) continue;
    for (size_t k = 0; k + 1 < s.particles.size(); ++k) {
      const uint32_t a = s.particles[k], b = s.particles[k + 1];
      const Stroke stroke{heatColor(std::abs(strainOf(p, s, k)) / kShownStrain), 1.6f};
      const Vec3 na = kLift * normals[a - v.first], nb = kLift * normals[b - v.first];
      canvas.line(p.positions()[a] + na, p.positions()[b] + nb, stroke);
      canvas.line(p.positions()[a] - na, p.positions()[b] - nb, stroke);
    }
  }
}

void drawStrand(const ParticleSystem& p, const ParticleStrand& s, const ThreadView& view, Canvas& canvas) {
  for (size_t k = 0; k + 1 < s.particles.size(); ++k) {
    const Vec3 a = p.positions()[s.particles[k]], b = p.positions()[s.particles[k + 1]];
    const float length = (b - a).norm();
    if (!(length > 0.0f)) continue;
    Paint paint = view.paint;
    if (view.strain) paint.color = heatColor(std::abs(strainOf(p, s, k)) / kShownStrain);
    canvas.solid(Capsule{0.5f * length, view.radius}, {0.5f * (a + b), turnFromX((b - a) / length)}, paint);
  }
}

void ParticleScene::add(World& world, ParticleDef def) {
  def.settings.substeps = static_cast<int>(substeps_);
  def.settings.iterations = static_cast<int>(iterations_);
  def.settings.friction = friction_;
  def.settings.damping = damping_;
  id_ = world.addParticles(def);
}

void ParticleScene::beforeStep(World& world, float dt) {
  script(world, dt);
  ParticleSettings s = world.particles(id_).settings();
  s.substeps = std::max(1, static_cast<int>(substeps_));
  s.iterations = std::max(1, static_cast<int>(iterations_));
  s.friction = friction_;
  s.damping = damping_;
  world.particles(id_).setSettings(s);
}

void ParticleScene::afterStep(World& world, float) {
  worst_strain_ = std::max(worst_strain_, particles(world).maxStrain());
}

std::vector<Parameter> ParticleScene::parameters() {
  return {{"sub-steps", "", &substeps_, 1.0f, 32.0f},
          {"rounds a sub-step", "", &iterations_, 1.0f, 8.0f},
          {"friction", "", &friction_, 0.0f, 1.5f},
          {"damping", "1/s", &damping_, 0.0f, 5.0f}};
}

std::vector<Reading> ParticleScene::readings(const World& world) const {
  return {{"largest strain now", "%", 100.0 * particles(world).maxStrain(), strain_limit_},
          {"largest strain so far", "%", 100.0 * worst_strain_},
          {"particles", "", static_cast<double>(particles(world).positions().size())}};
}

}  // namespace samples
