// What the overlays draw from, and one function for each group of them.
#pragma once

#include <vector>

#include "pfx/high_level/world/world.h"
#include "viewer/draw_list/recorder.h"
#include "viewer/run/overlays.h"

namespace viewer {

struct OverlayScene {
  const pfx::World& world;
  const Overlays& overlays;
  DrawList& list;
  float unit;                          // m, length of a long arrow: a share of the distance to what is looked at
  const std::vector<uint8_t>* shown;   // by body: 0 is left out; null: all are shown

  bool shows(uint32_t body) const { return !shown || (body < shown->size() && (*shown)[body]); }
  bool exists(uint32_t body) const { return world.isValid(world.bodyId(body)); }
};

// Where bodies were: positions by step (oldest first), by body.
using Trails = std::vector<std::vector<pfx::Vec3>>;
inline constexpr uint64_t kTrailSteps = 120;

// A ray whose way tells its length as well.
struct ProbeRay {
  pfx::Vec3 start, way;  // m
};

void addMasses(const OverlayScene& scene);
void addNames(const OverlayScene& scene);
void addTrails(const OverlayScene& scene, const Trails& trails);
void addContactOverlays(const OverlayScene& scene);
void addJointOverlays(const OverlayScene& scene);
void addIslandLabels(const OverlayScene& scene);
void addParticleOverlays(const OverlayScene& scene);
void addPairSearch(const OverlayScene& scene);
void addProbe(const OverlayScene& scene, const ProbeRay& probe);

// Colour of the island of each body, or 0.
std::vector<Color> islandColors(const pfx::World& world);

}  // namespace viewer
