// With c the centre and r the inner radius of a polytope, its support along n is at least n . c + r. The
// separation along an axis that belongs to one face or edge of A is therefore at most its height under the
// centre of B, less r of B.
#include "pfx/base_level/collision/polytope_sat.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

constexpr float kPreference = 5e-6f;  // of the size; see box_pair.cpp
constexpr int kChunk = 64;            // edges of B looked at together

struct EdgeArc {
  Vec3 n0, n1;     // normals of the two faces; of B negated; frame of A
  Vec3 turn;       // n1 x n0
  Vec3 vertex;     // an end of the edge
  Vec3 direction;  // not normalised
  uint16_t index;
};

float lowest(const Polytope& p, const Vec3& n) { return n.dot(p.vertices[farthestVertex(p, -n)]); }

// False when no unit vector n on the arc between the normals of two faces can have n . g > needed, given
// their products h0 and h1 with g. Such an n is a sum of the two normals with weights that add up to at most
// 1 / cos(half the arc).
bool arcCanReach(const Vec3& n0, const Vec3& n1, float h0, float h1, float needed) {
  const float h = std::max(h0, h1);
  if (needed <= 0.0f) return true;
  return h > 0.0f && 2.0f * h * h > needed * needed * (1.0f + n0.dot(n1)) * 0.999f;
}

// Largest n . g over the unit vectors on the arc from n0 to n1 (at most half a turn), all of them across
// `direction`.
float largestOnArc(const Vec3& n0, const Vec3& n1, const Vec3& direction, const Vec3& g) {
  const float h0 = n0.dot(g), h1 = n1.dot(g), cosine = n0.dot(n1);
  const float along = direction.dot(g);
  const float across = std::sqrt(std::max(0.0f, g.squaredNorm() - along * along / direction.squaredNorm()));
  const bool inside = h0 >= cosine * across && h1 >= cosine * across;
  return inside ? across : std::max(h0, h1);
}

EdgeArc arcOfA(const Polytope& a, uint16_t e) {
  const PolytopeEdge& edge = a.edges[e];
  const Vec3 &n0 = a.planes[edge.left].normal, &n1 = a.planes[edge.right].normal;
  return {n0, n1, n1.cross(n0), a.vertices[edge.v0], a.vertices[edge.v1] - a.vertices[edge.v0], e};
}

EdgeArc arcOfB(const Polytope& b, const RelativePose& pose, uint16_t e) {
  const PolytopeEdge& edge = b.edges[e];
  const Vec3 n0 = pose.rotation * -b.planes[edge.left].normal,
             n1 = pose.rotation * -b.planes[edge.right].normal;
  return {n0,
          n1,
          n1.cross(n0),
          pose.toA(b.vertices[edge.v0]),
          pose.rotation * (b.vertices[edge.v1] - b.vertices[edge.v0]),
          e};
}

bool arcsCross(const EdgeArc& a, const EdgeArc& b) {
  const float c0 = b.n0.dot(a.turn), c1 = b.n1.dot(a.turn);
  if (!(c0 * c1 < 0.0f)) return false;
  const float d0 = a.n0.dot(b.turn), d1 = a.n1.dot(b.turn);
  return d0 * d1 < 0.0f && c0 * d1 > 0.0f;
}

void tryEdges(const EdgeArc& a, const EdgeArc& b, PolytopeAxis& best) {
  if (!arcsCross(a, b)) return;
  Vec3 n = a.direction.cross(b.direction);
  const float squared = n.squaredNorm();
  if (!(squared > 1e-6f * a.direction.squaredNorm() * b.direction.squaredNorm())) return;  // nearly parallel
  n /= std::sqrt(squared);
  if (n.dot(a.n0 + a.n1) < 0.0f) n = -n;
  const float separation = n.dot(b.vertex - a.vertex);
  if (separation > best.separation) best = {PolytopeAxis::Kind::Edges, a.index, b.index, separation, n};
}

void searchFaces(const Polytope& a, const Polytope& b, const RelativePose& pose, float preference,
                 PolytopeAxis& best) {
  const Vec3 center_b = pose.toA(b.center), center_a = pose.toB(a.center);
  for (uint16_t f = 0; f < a.faces.size(); ++f) {
    const Plane& p = a.planes[f];
    if (p.normal.dot(center_b) - p.offset - b.inner_radius <= best.separation) continue;
    const PolytopeAxis axis = faceAxisA(a, b, pose, f);
    if (axis.separation > best.separation) best = axis;
  }
  for (uint16_t f = 0; f < b.faces.size(); ++f) {
    const Plane& p = b.planes[f];
    const float needed = best.separation + (best.kind == PolytopeAxis::Kind::FaceA ? preference : 0.0f);
    if (p.normal.dot(center_a) - p.offset - a.inner_radius <= needed) continue;
    const PolytopeAxis axis = faceAxisB(a, b, pose, f);
    if (axis.separation > needed) best = axis;
  }
}

// An edge is left out when the height of the other centre over its two faces is too small, and then when it
// is too small over all axes of the edge.
bool edgeCanWin(const Polytope& p, uint16_t e, const Vec3& other_center, float needed) {
  const Plane &p0 = p.planes[p.edges[e].left], &p1 = p.planes[p.edges[e].right];
  const float h0 = p0.normal.dot(other_center) - p0.offset, h1 = p1.normal.dot(other_center) - p1.offset;
  return arcCanReach(p0.normal, p1.normal, h0, h1, needed);
}

void searchEdges(const Polytope& a, const Polytope& b, const RelativePose& pose, PolytopeAxis& best) {
  const Vec3 center_b = pose.toA(b.center), center_a = pose.toB(a.center);
  EdgeArc chunk[kChunk];
  for (uint32_t next = 0; next < b.edges.size();) {
    int count = 0;
    for (; next < b.edges.size() && count < kChunk; ++next) {
      if (!edgeCanWin(b, uint16_t(next), center_a, best.separation + a.inner_radius)) continue;
      const EdgeArc arc = arcOfB(b, pose, uint16_t(next));
      const float bound = largestOnArc(arc.n0, arc.n1, arc.direction, arc.vertex - a.center) - a.inner_radius;
      if (bound > best.separation) chunk[count++] = arc;
    }
    for (uint32_t e = 0; e < a.edges.size() && count > 0; ++e) {
      if (!edgeCanWin(a, uint16_t(e), center_b, best.separation + b.inner_radius)) continue;
      const EdgeArc arc = arcOfA(a, uint16_t(e));
      const float bound = largestOnArc(arc.n0, arc.n1, arc.direction, center_b - arc.vertex) - b.inner_radius;
      if (bound <= best.separation) continue;
      for (int i = 0; i < count; ++i) tryEdges(arc, chunk[i], best);
    }
  }
}

}  // namespace

PolytopeAxis faceAxisA(const Polytope& a, const Polytope& b, const RelativePose& pose, uint16_t face) {
  const Plane& p = a.planes[face];
  const float separation = lowest(b, pose.rotateToB(p.normal)) + p.normal.dot(pose.position) - p.offset;
  return {PolytopeAxis::Kind::FaceA, face, 0, separation, p.normal};
}

PolytopeAxis faceAxisB(const Polytope& a, const Polytope& b, const RelativePose& pose, uint16_t face) {
  const Plane& p = b.planes[face];
  const Vec3 n = pose.rotation * p.normal;
  const float separation = lowest(a, n) - n.dot(pose.position) - p.offset;
  return {PolytopeAxis::Kind::FaceB, 0, face, separation, -n};
}

PolytopeAxis edgesAxis(const Polytope& a, const Polytope& b, const RelativePose& pose, uint16_t edge_a,
                       uint16_t edge_b) {
  PolytopeAxis axis;
  tryEdges(arcOfA(a, edge_a), arcOfB(b, pose, edge_b), axis);
  return axis;
}

PolytopeAxis leastOverlap(const Polytope& a, const Polytope& b, const RelativePose& pose,
                          const PolytopeAxis& start) {
  const float preference = kPreference * (a.inner_radius + b.inner_radius);
  PolytopeAxis face = start;
  if (start.kind == PolytopeAxis::Kind::Edges) {
    face = {};
    face.separation = start.separation - preference;  // what a face needs to be chosen before these edges
  }
  searchFaces(a, b, pose, preference, face);
  PolytopeAxis edges = face;
  edges.separation += preference;
  const bool start_wins = face.kind == PolytopeAxis::Kind::None;
  if (start_wins) edges = start;
  searchEdges(a, b, pose, edges);
  return start_wins || edges.kind == PolytopeAxis::Kind::Edges ? edges : face;
}

}  // namespace pfx
