// tilt = sin(phi / 2) gives all that is needed of the neighbour: n' = cos phi n + sin phi out.
#include "pfx/base_level/collision/mesh_normals.h"

#include <cmath>

namespace pfx {
namespace {

struct Angle {
  float sin, cos;
};

// sin and cos of phi from sin(phi / 2), |phi| <= 180 degrees.
Angle fullAngle(float half_sin) {
  const float half_cos = std::sqrt(std::max(0.0f, 1.0f - half_sin * half_sin));
  return {2.0f * half_sin * half_cos, 1.0f - 2.0f * half_sin * half_sin};
}

// True if no edge that leaves vertex `corner` rises along m, all around the vertex.
bool vertexHasNormal(const LargeMesh& mesh, uint32_t facet, int corner, const Vec3& m) {
  constexpr int kMaxFan = 256;  // a vertex with more facets is judged by these
  // Forwards across the edge that arrives at the corner, then, if the fan is open, backwards across the one that leaves.
  for (const bool forward : {true, false}) {
    uint32_t f = facet;
    int c = corner;
    for (int step = 0; step < kMaxFan; ++step) {
      const auto v = facetVertices(mesh, f);
      for (const int other : {(c + 1) % 3, (c + 2) % 3}) {
        const Vec3 d = v[other] - v[c];
        if (m.dot(d) > kLeanTolerance * d.norm()) return false;
      }
      const uint32_t across = mesh.neighbors[f][forward ? (c + 2) % 3 : c];
      if (across == kNoFacet) break;
      f = across >> 2;
      // The shared edge runs the other way in the neighbour: it leaves the corner there if it arrived here.
      c = forward ? static_cast<int>(across & 3) : static_cast<int>((across & 3) + 1) % 3;
      if (f == facet) return true;
    }
  }
  return true;
}

}  // namespace

Vec3 edgeOutward(const MeshTriangle& t, int k) {
  return (t.vertex[(k + 1) % 3] - t.vertex[k]).cross(t.normal).normalized();
}

Vec3 edgeFarNormal(const MeshTriangle& t, int k) {
  const Vec3 out = edgeOutward(t, k);
  if (t.kind[k] == EdgeKind::Open) return out;
  const Angle phi = fullAngle(t.tilt[k]);
  return phi.cos * t.normal + phi.sin * out;
}

Vec3 edgeFarOutward(const MeshTriangle& t, int k) {
  if (t.kind[k] == EdgeKind::Open) return -t.normal;
  const Angle phi = fullAngle(t.tilt[k]);
  return phi.cos * edgeOutward(t, k) - phi.sin * t.normal;
}

Vec3 edgeBisector(const MeshTriangle& t, int k) {
  if (t.kind[k] == EdgeKind::Open) return edgeOutward(t, k);
  const float half_cos = std::sqrt(std::max(0.0f, 1.0f - t.tilt[k] * t.tilt[k]));
  return half_cos * edgeOutward(t, k) - t.tilt[k] * t.normal;
}

bool hasNormal(const LargeMesh& mesh, uint32_t facet, const MeshTriangle& t, const Vec3& m) {
  if (m.dot(t.normal) < -kLeanTolerance) return false;
  float reach[3], highest = -1e30f, lowest = 1e30f;
  for (int k = 0; k < 3; ++k) {
    reach[k] = m.dot(t.vertex[k] - t.vertex[0]);
    highest = std::max(highest, reach[k]);
    lowest = std::min(lowest, reach[k]);
  }
  const float size = (t.vertex[1] - t.vertex[0]).norm() + (t.vertex[2] - t.vertex[0]).norm();
  const float level = highest - kLeanTolerance * size;
  if (lowest >= level) return true;  // the whole facet
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (reach[k] < level || reach[next] < level) continue;
    return offersNormals(t.kind[k]) && m.dot(edgeFarOutward(t, k)) <= kLeanTolerance;
  }
  for (int k = 0; k < 3; ++k) {
    if (reach[k] < level) continue;
    // Both edges of the facet at this vertex must let the normal lean over them before the fan is worth a walk.
    const int before = (k + 2) % 3;
    const bool leans_after = m.dot(edgeOutward(t, k)) > kLeanTolerance;
    const bool leans_before = m.dot(edgeOutward(t, before)) > kLeanTolerance;
    if ((leans_after && !offersNormals(t.kind[k])) || (leans_before && !offersNormals(t.kind[before]))) return false;
    return vertexHasNormal(mesh, facet, k, m);
  }
  return false;
}

}  // namespace pfx
