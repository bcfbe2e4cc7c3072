// What holds particles together: links by their strain, bends, volumes, and the particles themselves.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pfx/high_level/particles/particle_system.h"
#include "pfx/util/debug_render/palette.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr Color kFreeColor = 0xff2f6fb0, kHeldColor = 0xffb0471f, kAnchoredColor = 0xff8a4fb0, kBendColor = 0xff4a9ad4,
                kVolumeColor = 0xff5a4fa8;
constexpr float kLeastScale = 1e-4f;  // strain that is red at least

struct Link {
  Vec3 from, to;
  float strain;
};

void addLink(std::vector<Link>& links, const Vec3& from, const Vec3& to, float length) {
  links.push_back({from, to, length > 0.0f ? (to - from).norm() / length - 1.0f : 0.0f});
}

std::vector<Link> linksOf(const pfx::ParticleSystem& p) {
  std::vector<Link> links;
  const auto at = p.positions();
  for (const pfx::ParticleStrand& s : p.strands())
    for (size_t k = 0; k + 1 < s.particles.size(); ++k)
      addLink(links, at[s.particles[k]], at[s.particles[k + 1]], s.lengths[k]);
  for (const pfx::DistanceConstraint& d : p.distances()) addLink(links, at[d.a], at[d.b], d.length);
  return links;
}

// Green at rest; red where the strain is the largest of its system.
void addLinks(const OverlayScene& scene, const pfx::ParticleSystem& p) {
  const std::vector<Link> links = linksOf(p);
  float largest = kLeastScale;
  for (const Link& l : links) largest = std::max(largest, std::abs(l.strain));
  for (const Link& l : links)
    scene.list.add(
        Line{l.from, l.to, pfx::hsvColor(0.36f * (1.0f - std::abs(l.strain) / largest), 0.85f, 0.75f), 2.0f});
  char text[64];
  std::snprintf(text, sizeof text, "strain of %.3g %%", 100.0 * double(largest));
  if (!links.empty()) scene.list.add(LegendEntry{pfx::hsvColor(0.0f, 0.85f, 0.75f), text});
}

// A chord across each bend, from the middle of one link to that of the next.
void addBends(const OverlayScene& scene, const pfx::ParticleSystem& p) {
  const auto at = p.positions();
  for (const pfx::AngleConstraint& a : p.angles())
    scene.list.add(Line{0.5f * (at[a.a] + at[a.b]), 0.5f * (at[a.b] + at[a.c]), kBendColor, 2.0f});
}

void addVolumes(const OverlayScene& scene, const pfx::ParticleSystem& p) {
  const auto at = p.positions();
  for (const pfx::VolumeConstraint& v : p.volumes())
    for (const auto& [a, b] : {std::pair{v.a, v.b}, {v.a, v.c}, {v.a, v.d}, {v.b, v.c}, {v.b, v.d}, {v.c, v.d}})
      scene.list.add(Line{at[a], at[b], kVolumeColor, 1.0f});
}

void addPoints(const OverlayScene& scene, const pfx::ParticleSystem& p) {
  std::vector<Color> colors(p.positions().size(), kFreeColor);
  for (size_t i = 0; i < colors.size(); ++i)
    if (p.masses()[i] == 0.0f) colors[i] = kHeldColor;
  for (const pfx::ParticleAnchor& a : p.anchors()) colors[a.particle] = kAnchoredColor;
  for (size_t i = 0; i < colors.size(); ++i) scene.list.add(Point{p.positions()[i], colors[i], 5.0f});
}

}  // namespace

void addParticleOverlays(const OverlayScene& scene) {
  const Overlays& o = scene.overlays;
  if (scene.shown || (!o.links && !o.bends && !o.volumes && !o.particles)) return;
  for (uint32_t i = 0; i < scene.world.numParticleSystems(); ++i) {
    const pfx::ParticleSystem* p = scene.world.particles(i);
    if (!p) continue;
    if (o.links) addLinks(scene, *p);
    if (o.bends) addBends(scene, *p);
    if (o.volumes) addVolumes(scene, *p);
    if (o.particles) addPoints(scene, *p);
  }
  if (!o.particles || scene.world.numParticleSystems() == 0) return;
  scene.list.add(LegendEntry{kFreeColor, "free particle"});
  scene.list.add(LegendEntry{kHeldColor, "held in place"});
  scene.list.add(LegendEntry{kAnchoredColor, "part of a body"});
}

}  // namespace viewer
