// Outside, the normal comes from the closest points; with the segment inside, from the axis of least overlap.
// A segment along a face or an edge touches at both ends of the common stretch.
#include "pfx/base_level/collision/segment_polytope.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_reduction.h"

namespace pfx {
namespace {

struct Segment {
  Vec3 p0, p1;  // frame of the polytope
  Vec3 at(float u) const { return p0 + u * (p1 - p0); }
};

struct Axis {
  Vec3 normal = Vec3::UnitY();
  float separation = -1e30f;
};

// Axis of least overlap over face normals and cross products of edges with the segment. Every candidate is
// measured with the true support of the polytope, so each one is a valid axis.
Axis leastOverlap(const Polytope& polytope, const ConvexCore& core, const Segment& segment) {
  Axis best;
  for (const Plane& plane : polytope.planes) {
    const float s = std::min(plane.normal.dot(segment.p0), plane.normal.dot(segment.p1)) - plane.offset;
    if (s > best.separation) best = {plane.normal, s};
  }
  const Vec3 along = segment.p1 - segment.p0;
  for (const PolytopeEdge& edge : polytope.edges) {
    Vec3 n = (polytope.vertices[edge.v1] - polytope.vertices[edge.v0]).cross(along);
    const float length = n.norm();
    if (!(length > 1e-4f * along.norm() * (polytope.vertices[edge.v1] - polytope.vertices[edge.v0]).norm()))
      continue;
    n /= length;
    if (n.dot(polytope.vertices[edge.v0] - polytope.center) < 0.0f) n = -n;
    const float s = std::min(n.dot(segment.p0), n.dot(segment.p1)) - n.dot(core.support(n).point);
    if (s > best.separation + 1e-5f * polytope.inner_radius) best = {n, s};
  }
  return best;
}

constexpr uint32_t kEdgeFeature = 0x40000000u;  // beyond the names of faces

struct RoundedReach {
  float radius, margin;  // m
};

struct Stretch {
  float lo = 0.0f, hi = 1.0f;
  bool empty() const { return !(lo < hi); }
};

// Part of the segment over the face, seen along n.
Stretch clipByFace(const Polytope& polytope, uint32_t face, const Segment& segment, const Vec3& n) {
  Stretch s;
  const auto loop = polytope.face(face);
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &r0 = polytope.vertices[loop[i]],
               &r1 = polytope.vertices[loop[i + 1 < loop.size() ? i + 1 : 0]];
    const Vec3 outward = (r1 - r0).cross(n);
    const float d0 = outward.dot(segment.p0 - r0), d1 = outward.dot(segment.p1 - r0);
    if (d0 > 0.0f && d1 > 0.0f) return {1.0f, 0.0f};
    if (d0 > 0.0f) s.lo = std::max(s.lo, d0 / (d0 - d1));
    if (d1 > 0.0f) s.hi = std::min(s.hi, d0 / (d0 - d1));
  }
  return s;
}

// The longest edge that lies farthest along n and nearly parallel to the segment, seen along n, or null.
const PolytopeEdge* parallelEdge(const Polytope& polytope, const Segment& segment, const Vec3& n) {
  constexpr float kParallel = 0.05f;  // sine of the angle, three degrees
  const float top = n.dot(polytope.vertices[farthestVertex(polytope, n)]);
  const Vec3 along = (segment.p1 - segment.p0).normalized();
  const PolytopeEdge* best = nullptr;
  float longest = 0.0f;
  for (const PolytopeEdge& edge : polytope.edges) {
    const Vec3 &v0 = polytope.vertices[edge.v0], &v1 = polytope.vertices[edge.v1];
    const float length = (v1 - v0).norm();
    if (std::min(n.dot(v0), n.dot(v1)) < top - kParallel * length) continue;
    if ((v1 - v0).cross(along).norm() > kParallel * length || length <= longest) continue;
    best = &edge, longest = length;
  }
  return best;
}

// Both ends of the stretch where the segment runs beside an edge.
int edgeContacts(const Polytope& polytope, const PolytopeEdge& edge, const Segment& segment,
                 const LocalManifold& m, const RoundedReach& reach, LocalContact* out) {
  const Vec3 &v0 = polytope.vertices[edge.v0], axis = polytope.vertices[edge.v1] - v0;
  const float length = axis.squaredNorm();
  const auto along = [&](const Vec3& p) { return std::clamp(axis.dot(p - v0) / length, 0.0f, 1.0f); };
  const float t0 = along(segment.p0), t1 = along(segment.p1);
  const Vec3 span = segment.p1 - segment.p0;
  int count = 0;
  for (const float t : {std::min(t0, t1), std::max(t0, t1)}) {
    const Vec3 on_edge = v0 + t * axis;
    const float u = std::clamp(span.dot(on_edge - segment.p0) / span.squaredNorm(), 0.0f, 1.0f);
    const Vec3 on_surface = segment.at(u) - reach.radius * m.normal;
    const LocalContact c = oppositePoints(on_edge, on_surface, m.normal, kEdgeFeature + uint32_t(count));
    if (c.distance <= reach.margin) out[count++] = c;
  }
  return std::abs(t1 - t0) > 1e-3f ? count : 0;
}

}  // namespace

void collidePolytopeCapsule(const Polytope& polytope, const ConvexCore& core, const Capsule& capsule,
                            const LocalPair& pair, LocalResult& result) {
  const float radius = capsule.radius;
  const Vec3 half = capsule.half_length * pair.b_in_a.rotation.col(0);
  const Segment segment{pair.b_in_a.position - half, pair.b_in_a.position + half};
  LocalManifold& m = result.manifold;

  const ConvexCore line = segmentCore(capsule);
  const GjkResult gjk = gjkDistance({core, line, pair.b_in_a, pair.axis, radius + pair.margin});
  float core_distance = gjk.distance;
  Vec3 on_polytope = gjk.point_a, on_segment = gjk.point_b;
  m.normal = gjk.normal;
  if (gjk.state == GjkResult::State::BeyondLimit || gjk.distance - radius > pair.margin) {
    result.separation = gjk.distance - radius;
    return;
  }
  // Closer than a thousandth of the polytope the direction between the closest points is mostly rounding.
  if (gjk.state == GjkResult::State::Touching || gjk.distance < 1e-4f * polytope.inner_radius) {
    const Axis axis = leastOverlap(polytope, core, segment);
    m.normal = axis.normal;
    core_distance = axis.separation;
    const bool first = axis.normal.dot(segment.p0) < axis.normal.dot(segment.p1);
    on_segment = first ? segment.p0 : segment.p1;
    on_polytope = on_segment - core_distance * m.normal;
  }

  LocalContact candidates[3];
  int count = 0;
  const uint32_t face = supportingFace(polytope, m.normal);
  const Plane& plane = polytope.planes[face];
  const float slope = plane.normal.dot(m.normal);
  if (slope > 0.95f && capsule.half_length > 0.0f) {
    const Stretch over = clipByFace(polytope, face, segment, m.normal);
    for (int end = 0; end < 2 && !over.empty(); ++end) {
      const Vec3 s = segment.at(end == 0 ? over.lo : over.hi);
      const float d = (plane.normal.dot(s) - plane.offset) / slope;
      if (d - radius > pair.margin) continue;
      candidates[count++] = {s - d * m.normal, s - radius * m.normal, d - radius, 2u + end + 4u * face};
    }
  }
  if (count == 0 && capsule.half_length > 0.0f) {
    if (const PolytopeEdge* edge = parallelEdge(polytope, segment, m.normal))
      count = edgeContacts(polytope, *edge, segment, m, {radius, pair.margin}, candidates);
  }
  const float near = 1e-3f * (capsule.half_length + radius);
  bool covered = false;
  for (int i = 0; i < count; ++i)
    covered |= (candidates[i].point_b - (on_segment - radius * m.normal)).norm() < near;
  const bool deeper =
      count == 0 || core_distance - radius <
                        std::min(candidates[0].distance, candidates[count - 1].distance) - 0.01f * near;
  if (!covered && deeper)
    candidates[count++] = {on_polytope, on_segment - radius * m.normal, core_distance - radius, 1};
  reduceContacts({candidates, size_t(count)}, m);
}

}  // namespace pfx
