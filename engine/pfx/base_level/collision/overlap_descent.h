// Axis of least overlap of two convex cores of which one at least is curved, so that no finite list of axes
// holds it.
#pragma once

#include <span>

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/collision/local_manifold.h"

namespace pfx {

struct CoreAxis {
  Vec3 normal = Vec3::UnitY();  // unit, from A to B, frame of A
  float separation = -1e30f;    // m, negative: overlap
  Vec3 point_a = Vec3::Zero();  // m, a deepest point, frame of A
  Vec3 point_b = Vec3::Zero();
};

// Signed gap of the cores along a unit axis from A to B (m).
float separationAlong(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a, const Vec3& axis);

// From the unit axis `start`, B is pulled out until there is a small gap, and the direction between the
// closest points is the next axis. The overlap never grows on the way, and where it stops shrinking the axis
// is a local minimum. Idea: Y. J. Kim, M. C. Lin, D. Manocha, Incremental Penetration Depth Estimation
// between Convex Polytopes, IEEE TVCG 10(2), 2004.
CoreAxis descendOverlap(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a,
                        const Vec3& start);

// Descends from the best of `candidates` (unit, from A to B; at least one). An overlap that is deep compared
// to the smaller core has several local minima: it is searched from several sides.
CoreAxis leastOverlap(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a,
                      std::span<const Vec3> candidates);

}  // namespace pfx
