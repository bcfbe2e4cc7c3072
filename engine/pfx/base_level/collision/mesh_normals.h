// Which normals the surface of a mesh has at the features of a facet.
#pragma once

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// How far, as the sine of an angle, a normal may lean over an edge and still count as belonging to it.
inline constexpr float kLeanTolerance = 1e-3f;

// In the plane of the facet, square to edge k, outwards; unit.
Vec3 edgeOutward(const MeshTriangle& t, int k);

// Normal of the facet across edge k. Of an open edge: the outward direction, where the surface ends.
Vec3 edgeFarNormal(const MeshTriangle& t, int k);

// In the plane of the facet across edge k, square to the edge, away from this facet; unit. Of an open edge: backwards.
Vec3 edgeFarOutward(const MeshTriangle& t, int k);

// Outward normal of the plane that divides, at edge k, what belongs to this facet from what belongs to the next: it
// halves the angle between them, so that thick facets neither overlap behind a convex edge nor leave a gap behind a
// concave one.
Vec3 edgeBisector(const MeshTriangle& t, int k);

inline bool offersNormals(EdgeKind k) { return k == EdgeKind::Convex || k == EdgeKind::Open; }
inline bool offersNormals(const MeshTriangle& t) {
  return offersNormals(t.kind[0]) || offersNormals(t.kind[1]) || offersNormals(t.kind[2]);
}

// True if the part of the facet that lies farthest along the unit vector m is also locally the farthest part of the
// whole surface: m is a normal that the mesh has there.
bool hasNormal(const LargeMesh& mesh, uint32_t facet, const MeshTriangle& t, const Vec3& m);

}  // namespace pfx
