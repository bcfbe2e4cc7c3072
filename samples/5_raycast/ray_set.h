// Rays with what they hit: how they are drawn, and how far their hits are from the surfaces.
#pragma once

#include <vector>

#include "pfx/high_level/world/world.h"
#include "samples/scene.h"

namespace samples {

struct RaySet {
  std::vector<pfx::RayInput> rays;
  std::vector<pfx::RayOutput> hits;  // one a ray

  int numHits() const;
};

// The rays cast at the whole world.
RaySet castAt(const pfx::World& world, std::vector<pfx::RayInput> rays);

// `count` rays from a ring of `radius` (m) at `height` inward and down to a smaller ring below y = 0, turned by `angle`.
struct Ring {
  int count = 100;
  float radius = 15.0f, height = 9.0f;      // m
  float end_radius = 8.0f, depth = 6.0f;    // m
  float angle = 0.0f;                       // rad
};
std::vector<pfx::RayInput> ringOfRays(const Ring& ring);

// Rays to their hits, a point and the normal there, the outline of a triangle that was hit; what hits nothing is faint.
void draw(const RaySet& set, const pfx::World& world, Canvas& canvas);

// Largest distance of a hit from the surface of the shape that it names (m), by the collision functions, which know
// nothing of rays.
double farthestFromSurface(const RaySet& set, const pfx::World& world);

}  // namespace samples
