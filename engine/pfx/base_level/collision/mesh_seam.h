// Where two meshes meet: an edge of one that the other continues is no edge.
//
// A mesh does not know that its surface goes on in another body. At such a seam it offers normals that the
// surface as a whole does not have, and what slides over it would be caught. A normal is right where a facet
// has it, or where no facet that holds the same point rises above its tangent plane.
#pragma once

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

struct SurfacePoint {
  Vec3 point;          // m
  Vec3 normal;         // unit
  float slack = 0.0f;  // m, how far the point may be off
};

// What the facets that hold a point say of a normal there. Facets count when the point is off by less than
// its slack and a thousandth of their size.
struct SeamVerdict {
  bool is_facet_normal = false;
  bool is_covered = false;  // a facet rises above the tangent plane

  bool isGhost() const { return is_covered && !is_facet_normal; }
};

// Adds what the facets of a mesh say; `at` in the mesh frame.
void judge(const LargeMesh& mesh, const SurfacePoint& at, SeamVerdict& verdict);

}  // namespace pfx
