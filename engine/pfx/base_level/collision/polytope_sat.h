// Axis of least overlap of two polytopes, over all face normals and all pairs of edges that form a face of
// the Minkowski difference.
#pragma once

#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/shape/polytope.h"

namespace pfx {

struct PolytopeAxis {
  enum class Kind : uint8_t { None, FaceA, FaceB, Edges };
  Kind kind = Kind::None;
  uint16_t a = 0, b = 0;        // faces or edges that define the axis
  float separation = -1e30f;    // m, negative: overlap
  Vec3 normal = Vec3::UnitY();  // unit, from A to B, frame of A
};

// Gap along the normal of one face, signed (m).
PolytopeAxis faceAxisA(const Polytope& a, const Polytope& b, const RelativePose& b_in_a, uint16_t face);
PolytopeAxis faceAxisB(const Polytope& a, const Polytope& b, const RelativePose& b_in_a, uint16_t face);

// Gap along the common perpendicular of two edges; kind None when they do not form a face of the Minkowski
// difference.
PolytopeAxis edgesAxis(const Polytope& a, const Polytope& b, const RelativePose& b_in_a, uint16_t edge_a,
                       uint16_t edge_b);

// The axis with the largest separation. `start` is an axis that is already known (kind None: nothing known);
// a good one makes the search short, because a face or edge is skipped when balls inside the polytopes prove
// that it cannot do better. An edge axis must beat the faces by a few millionths of the size. Sources: S.
// Gottschalk et al., OBBTree, SIGGRAPH 1996; D. Gregorius, The Separating Axis Test between Convex Polyhedra,
// GDC 2013 (Gauss map).
PolytopeAxis leastOverlap(const Polytope& a, const Polytope& b, const RelativePose& b_in_a,
                          const PolytopeAxis& start);

}  // namespace pfx
