// Impulses, friction, overlap, features and graph colours of contact points.
#include <algorithm>
#include <cstdio>

#include "pfx/low_level/island/colouring.h"
#include "pfx/util/debug_render/palette.h"
#include "viewer/run/overlay_scene.h"

namespace viewer {
namespace {

using pfx::Vec3;

constexpr Color kImpulseColor = 0xff2f6fb0, kFrictionColor = 0xffb0471f;
constexpr float kDeep = 1e-3f;      // m, drawn red
constexpr size_t kMostLabels = 80;  // more cannot be read

struct Touch {
  Vec3 at, normal;  // m, on the second body; from the first body to the second
  const pfx::ContactPoint* point;
  uint32_t pick, manifold;
};

std::vector<Touch> touches(const OverlayScene& scene, std::vector<pfx::Link>& links) {
  std::vector<Touch> all;
  const auto pairs = scene.world.contactPairs();
  for (uint32_t i = 0; i < pairs.size(); ++i)
    for (const pfx::ContactManifold& m : scene.world.manifolds(pairs[i])) {
      if (m.num_points == 0) continue;
      links.push_back({pairs[i].body_a, pairs[i].body_b});
      if (!scene.shows(pairs[i].body_a) && !scene.shows(pairs[i].body_b)) continue;
      const pfx::Transform pose = scene.world.states()[pairs[i].body_b].pose();
      for (int k = 0; k < m.num_points; ++k) {
        const pfx::ContactPoint& p = m.points[size_t(k)];
        all.push_back({pose.apply(p.local_b), m.normal, &p, pickId(PickKind::Contact, i), uint32_t(links.size()) - 1});
      }
    }
  return all;
}

// Arrows as long as their share of the largest impulse; the legend tells what that is.
template <class ImpulseOf>
void addArrows(const OverlayScene& scene, std::span<const Touch> all, Color color, const char* name,
               const ImpulseOf& impulseOf) {
  float largest = 0.0f;
  for (const Touch& t : all) largest = std::max(largest, impulseOf(t).norm());
  if (!(largest > 0.0f)) return;
  for (const Touch& t : all)
    if (const Vec3 impulse = impulseOf(t); impulse.norm() > 0.01f * largest)
      scene.list.add(Arrow{t.at, t.at + scene.unit / largest * impulse, color, 2.5f, t.pick});
  char text[64];
  std::snprintf(text, sizeof text, "%s, longest %.3g N s", name, double(largest));
  scene.list.add(LegendEntry{color, text});
}

void addDepths(const OverlayScene& scene, std::vector<Touch> all) {
  for (const Touch& t : all) {
    const float share = std::clamp(-t.point->distance / kDeep, 0.0f, 1.0f);
    scene.list.add(Point{t.at, pfx::hsvColor(0.36f * (1.0f - share), 0.75f, 0.85f), 6.0f + 6.0f * share, t.pick});
  }
  std::ranges::stable_sort(all, {}, [](const Touch& t) { return t.point->distance; });
  for (size_t i = 0; i < std::min<size_t>(all.size(), 12); ++i) {
    if (all[i].point->distance >= 0.0f) break;
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", -1e3 * double(all[i].point->distance));
    scene.list.add(Label{.position = all[i].at, .text = text});
  }
}

// The solver colours its constraints in the order of the pairs; the same colouring shows what it does.
void addColours(const OverlayScene& scene, std::span<const Touch> all, std::span<const pfx::Link> links) {
  std::vector<uint8_t> dynamic;
  for (const pfx::RigidState& s : scene.world.states())
    dynamic.push_back(pfx::isDynamic(s.motion_type) && !s.asleep);
  pfx::Colouring colouring;
  colouring.build(links, dynamic);
  std::vector<Color> colors(links.size(), 0xff000000u);
  for (uint32_t c = 0; c < colouring.size(); ++c)
    for (uint32_t link : colouring.links(c)) colors[link] = pfx::indexColor(c);
  for (const Touch& t : all) scene.list.add(Point{t.at, colors[t.manifold], 9.0f, t.pick});
  scene.list.add(LegendEntry{pfx::indexColor(0), std::to_string(colouring.size()) + " graph colours"});
}

}  // namespace

void addContactOverlays(const OverlayScene& scene) {
  const Overlays& o = scene.overlays;
  if (!o.impulses && !o.friction && !o.penetration && !o.features && !o.colours) return;
  std::vector<pfx::Link> links;
  const std::vector<Touch> all = touches(scene, links);
  if (o.impulses)
    addArrows(scene, all, kImpulseColor, "impulse", [](const Touch& t) { return Vec3(t.point->normal_impulse * t.normal); });
  if (o.friction)
    addArrows(scene, all, kFrictionColor, "friction", [](const Touch& t) { return t.point->friction_impulse; });
  if (o.penetration) addDepths(scene, all);
  if (o.colours) addColours(scene, all, links);
  if (!o.features) return;
  for (size_t i = 0; i < std::min(all.size(), kMostLabels); ++i) {
    char text[16];
    std::snprintf(text, sizeof text, "%x", all[i].point->feature);
    scene.list.add(Label{.position = all[i].at, .text = text});
  }
}

}  // namespace viewer
