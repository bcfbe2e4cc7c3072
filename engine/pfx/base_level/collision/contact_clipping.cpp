// A vertex of the clipped polygon carries the two edges that it lies between; they name it from frame to
// frame.
#include "pfx/base_level/collision/contact_clipping.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_reduction.h"

namespace pfx {
namespace {

constexpr int kMaxClipped = 2 * kMaxFaceVertices + 2;
constexpr uint32_t kReferenceEdge = 0x100;

// A vertex this fraction of the smaller face outside a side plane still counts as inside. Edges that lie on
// top of each other would otherwise flicker between two names.
constexpr float kInsideTolerance = 1e-4f;

struct ClipVertex {
  Vec3 p;
  float side;  // m, outside of the current plane
  uint32_t edge_in, edge_out;
};

float extent(const ContactPolygon& polygon) {
  float squared = 0.0f;
  for (int i = 1; i < polygon.count; ++i)
    squared = std::max(squared, (polygon.vertices[i] - polygon.vertices[0]).squaredNorm());
  return std::sqrt(squared);
}

// One pass of the clipper: keeps what lies on the inner side of `plane`, which belongs to reference edge
// `edge`.
int clipByPlane(ClipVertex* in, int count, const Plane& plane, uint32_t edge, float tolerance,
                ClipVertex* out) {
  for (int i = 0; i < count; ++i) in[i].side = plane.normal.dot(in[i].p) - plane.offset;
  int n = 0;
  for (int i = 0; i < count; ++i) {
    const ClipVertex& p = in[i];
    const ClipVertex& q = in[i + 1 < count ? i + 1 : 0];
    const bool p_inside = p.side <= tolerance, q_inside = q.side <= tolerance;
    if (p_inside) out[n++] = p;
    if (p_inside == q_inside) continue;
    const float u = std::clamp(p.side / (p.side - q.side), 0.0f, 1.0f);
    const Vec3 x = p.p + u * (q.p - p.p);
    out[n++] = p_inside ? ClipVertex{x, 0.0f, p.edge_out, edge} : ClipVertex{x, 0.0f, edge, p.edge_out};
  }
  return n;
}

uint32_t featureName(const ClipVertex& v, const ClipInput& in) {
  return (v.edge_in & 0x1ff) | (v.edge_out & 0x1ff) << 9 | (in.reference.id & 0x3f) << 18 |
         (in.incident.id & 0x3f) << 24 | uint32_t(in.reference_is_a) << 30 | 1u << 31;
}

}  // namespace

uint32_t supportingFaceAt(const Polytope& polytope, const Vec3& direction, uint32_t vertex) {
  uint32_t best = 0;
  float cosine = -2.0f;
  for (uint32_t f = 0; f < polytope.planes.size(); ++f) {
    const float c = polytope.planes[f].normal.dot(direction);
    if (!(c > cosine)) continue;
    const auto loop = polytope.face(f);
    if (std::find(loop.begin(), loop.end(), uint16_t(vertex)) != loop.end()) cosine = c, best = f;
  }
  return best;
}

void loadFace(const Polytope& polytope, uint32_t face, ContactPolygon& polygon) {
  polygon.normal = polytope.planes[face].normal;
  polygon.id = face;
  polygon.count = 0;
  for (uint16_t v : polytope.face(face)) polygon.vertices[polygon.count++] = polytope.vertices[v];
}

void loadFace(const Polytope& polytope, uint32_t face, const RelativePose& pose, ContactPolygon& polygon) {
  polygon.normal = pose.rotation * polytope.planes[face].normal;
  polygon.id = face;
  polygon.count = 0;
  for (uint16_t v : polytope.face(face)) polygon.vertices[polygon.count++] = pose.toA(polytope.vertices[v]);
}

void clipFaces(const ClipInput& in, LocalManifold& manifold) {
  const ContactPolygon& ref = in.reference;
  const Vec3& n = manifold.normal;
  const float tolerance = kInsideTolerance * std::min(extent(ref), extent(in.incident));

  ClipVertex buffers[2][kMaxClipped];
  ClipVertex *current = buffers[0], *next = buffers[1];
  int count = in.incident.count;
  for (int i = 0; i < count; ++i) {
    current[i] = {in.incident.vertices[i], 0.0f, uint32_t(i > 0 ? i - 1 : count - 1), uint32_t(i)};
  }
  const float orientation = ref.normal.dot(n) >= 0.0f ? 1.0f : -1.0f;
  for (int i = 0; i < ref.count && count > 0; ++i) {
    const Vec3& r = ref.vertices[i];
    const Vec3 side = (ref.vertices[i + 1 < ref.count ? i + 1 : 0] - r).cross(orientation * n);
    const float length = side.norm();
    if (!(length > 0.0f)) continue;
    const Vec3 outward = side / length;
    count =
        clipByPlane(current, count, {outward, outward.dot(r)}, kReferenceEdge | uint32_t(i), tolerance, next);
    std::swap(current, next);
  }

  LocalContact candidates[kMaxClipped];
  int num_candidates = 0;
  const float slope = ref.normal.dot(n);
  for (int i = 0; i < count; ++i) {
    const Vec3& p = current[i].p;
    const float along = ref.normal.dot(p - ref.vertices[0]) / slope;  // from the reference plane, along n
    const float distance = in.reference_is_a ? along : -along;
    if (!(distance <= in.margin)) continue;
    const Vec3 q = p - along * n;
    candidates[num_candidates++] = in.reference_is_a
                                       ? LocalContact{q, p, distance, featureName(current[i], in)}
                                       : LocalContact{p, q, distance, featureName(current[i], in)};
  }
  reduceContacts({candidates, size_t(num_candidates)}, manifold);
}

SegmentPair closestOnSegments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
  const float a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  if (!(a > 0.0f) && !(e > 0.0f)) return {};
  if (!(a > 0.0f)) return {0.0f, std::clamp(f / e, 0.0f, 1.0f)};
  const float c = d1.dot(r);
  if (!(e > 0.0f)) return {std::clamp(-c / a, 0.0f, 1.0f), 0.0f};
  const float b = d1.dot(d2), denominator = a * e - b * b;
  float s = denominator > 1e-6f * a * e ? std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f) : 0.5f;
  float t = (b * s + f) / e;
  if (t < 0.0f) {
    t = 0.0f;
    s = std::clamp(-c / a, 0.0f, 1.0f);
  } else if (t > 1.0f) {
    t = 1.0f;
    s = std::clamp((b - c) / a, 0.0f, 1.0f);
  }
  return {s, t};
}

}  // namespace pfx
