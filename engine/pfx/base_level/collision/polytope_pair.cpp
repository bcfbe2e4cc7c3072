// Distance first: most pairs whose bounds meet do not touch. Then the axis: for a gap from the closest
// points, for an overlap from the separating-axis search. Then the patch.
#include "pfx/base_level/collision/polytope_pair.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_clipping.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/pair_functions.h"
#include "pfx/base_level/collision/polytope_sat.h"

namespace pfx {
namespace {

using Kind = PolytopeAxis::Kind;

constexpr float kHysteresis = 1e-3f;  // of the smaller inner radius; see box_pair.cpp
// Below this gap, as a fraction of the size, the direction between the closest points is mostly rounding.
constexpr float kNear = 1e-4f;
// A face normal stands for the axis when its gap is short of the distance by no more than this fraction of
// the size.
constexpr float kFaceGap = 1e-6f;
constexpr float kSameDepth = 1e-5f;  // of the size: depths that count as equal

uint32_t encode(const PolytopeAxis& axis) {
  if (axis.a > 0x7fff || axis.b > 0x7fff) return 0;
  return uint32_t(axis.kind) << 30 | uint32_t(axis.a) << 15 | axis.b;
}

// The axis of the last frame, measured now; kind None when there was none.
PolytopeAxis rememberedAxis(const PolytopePair& p, const LocalPair& pair) {
  const Kind kind = Kind(pair.hint >> 30);
  const uint16_t a = uint16_t(pair.hint >> 15 & 0x7fff), b = uint16_t(pair.hint & 0x7fff);
  if (kind == Kind::FaceA && a < p.a.faces.size()) return faceAxisA(p.a, p.b, pair.b_in_a, a);
  if (kind == Kind::FaceB && b < p.b.faces.size()) return faceAxisB(p.a, p.b, pair.b_in_a, b);
  if (kind == Kind::Edges && a < p.a.edges.size() && b < p.b.edges.size()) {
    return edgesAxis(p.a, p.b, pair.b_in_a, a, b);
  }
  return {};
}

// The face that a polytope turns to its partner: one at its farthest corner.
uint32_t turnedFace(const Polytope& polytope, const ConvexCore& core, const Vec3& direction) {
  return supportingFaceAt(polytope, direction, core.support(direction).id);
}

void facePatch(const PolytopePair& p, const PolytopeAxis& axis, const LocalPair& pair, LocalManifold& m) {
  ContactPolygon face_a, face_b;
  const Vec3 to_b = -pair.b_in_a.rotateToB(axis.normal);
  const uint32_t fa = axis.kind == Kind::FaceA ? axis.a : turnedFace(p.a, p.core_a, axis.normal);
  const uint32_t fb = axis.kind == Kind::FaceB ? axis.b : turnedFace(p.b, p.core_b, to_b);
  loadFace(p.a, fa, face_a);
  loadFace(p.b, fb, pair.b_in_a, face_b);
  if (axis.kind == Kind::FaceA) {
    clipFaces({face_a, face_b, true, pair.margin}, m);
  } else {
    clipFaces({face_b, face_a, false, pair.margin}, m);
  }
}

void edgePoint(const PolytopePair& p, const PolytopeAxis& axis, const LocalPair& pair, LocalManifold& m) {
  const PolytopeEdge &ea = p.a.edges[axis.a], &eb = p.b.edges[axis.b];
  const Vec3 &a0 = p.a.vertices[ea.v0], &a1 = p.a.vertices[ea.v1];
  const Vec3 b0 = pair.b_in_a.toA(p.b.vertices[eb.v0]), b1 = pair.b_in_a.toA(p.b.vertices[eb.v1]);
  const SegmentPair at = closestOnSegments(a0, a1, b0, b1);
  const Vec3 on_a = a0 + at.s * (a1 - a0), on_b = b0 + at.t * (b1 - b0);
  m.add(oppositePoints(on_a, on_b, axis.normal, encode(axis)));
}

// The axis of a pair with a clear gap: a face normal where the closest points lie on a face, else their
// direction.
PolytopeAxis gapAxis(const PolytopePair& p, const LocalPair& pair, const GjkResult& gjk, float size) {
  const auto face_a = uint16_t(supportingFace(p.a, gjk.normal));
  const auto face_b = uint16_t(supportingFace(p.b, -pair.b_in_a.rotateToB(gjk.normal)));
  const PolytopeAxis a = faceAxisA(p.a, p.b, pair.b_in_a, face_a),
                     b = faceAxisB(p.a, p.b, pair.b_in_a, face_b);
  const float needed = gjk.distance - kFaceGap * (size + gjk.distance);
  const bool b_before = Kind(pair.hint >> 30) == Kind::FaceB;
  if (b_before && b.separation >= needed) return b;
  if (a.separation >= needed) return a;
  if (b.separation >= needed) return b;
  return {Kind::None, 0, 0, gjk.distance, gjk.normal};
}

PolytopeAxis overlapAxis(const PolytopePair& p, const LocalPair& pair, const PolytopeAxis& last) {
  PolytopeAxis start = last;
  if (start.kind == Kind::None) {
    Vec3 toward = pair.b_in_a.toA(p.b.center) - p.a.center;
    if (toward.isZero(0.0f)) toward = Vec3::UnitY();
    start = faceAxisA(p.a, p.b, pair.b_in_a, uint16_t(supportingFace(p.a, toward)));
  }
  const PolytopeAxis best = leastOverlap(p.a, p.b, pair.b_in_a, start);
  const float hysteresis = kHysteresis * std::min(p.a.inner_radius, p.b.inner_radius);
  const bool was_face = last.kind == Kind::FaceA || last.kind == Kind::FaceB;
  return was_face && last.separation > best.separation - hysteresis ? last : best;
}

void facesOrEdges(const PolytopePair& p, const PolytopeAxis& axis, const LocalPair& pair,
                  LocalResult& result) {
  result.manifold.normal = axis.normal;
  result.hint = encode(axis);
  if (axis.kind == Kind::FaceA || axis.kind == Kind::FaceB) facePatch(p, axis, pair, result.manifold);
  if (axis.kind == Kind::Edges) edgePoint(p, axis, pair, result.manifold);
}

void collideOverlapping(const PolytopePair& p, const PolytopeAxis& axis, const LocalPair& pair,
                        LocalResult& result) {
  LocalManifold& m = result.manifold;
  facesOrEdges(p, axis, pair, result);
  if (m.num_points > 0) return;
  // Rounding clipped everything away although the shapes meet: the deepest corner of B stands for the patch.
  const Vec3 q = pair.b_in_a.toA(p.core_b.support(-pair.b_in_a.rotateToB(axis.normal)).point);
  m.add({q - axis.separation * axis.normal, q, axis.separation, 1});
}

}  // namespace

void collidePolytopes(const PolytopePair& p, const LocalPair& pair, LocalResult& result) {
  LocalManifold& m = result.manifold;
  const float size = p.a.inner_radius + p.b.inner_radius, near = kNear * size;

  // A pair that overlapped along its last axis mostly still overlaps; the search of axes tells, without the
  // distance.
  const PolytopeAxis last = rememberedAxis(p, pair);
  if (last.kind != Kind::None && last.separation < -near) {
    const PolytopeAxis axis = overlapAxis(p, pair, last);
    if (axis.separation < -near) return collideOverlapping(p, axis, pair, result);
  }

  const GjkResult gjk = gjkDistance({p.core_a, p.core_b, pair.b_in_a, pair.axis, pair.margin});
  m.normal = gjk.normal;
  if (gjk.state == GjkResult::State::BeyondLimit || gjk.distance > pair.margin) {
    result.separation = gjk.distance;
    return;
  }
  if (gjk.state == GjkResult::State::Touching || gjk.distance <= near) {
    return collideOverlapping(p, overlapAxis(p, pair, last), pair, result);
  }
  facesOrEdges(p, gapAxis(p, pair, gjk, size), pair, result);
  if (deepest(m) <= gjk.distance + kSameDepth * size) return;
  m.num_points = 0;  // the closest points lie beside the face
  m.normal = gjk.normal;
  m.add({gjk.point_a, gjk.point_b, gjk.distance, 1});
}

void collideConvexConvex(const LocalPair& pair, LocalResult& result) {
  const Polytope a = std::get<const ConvexMesh*>(pair.a)->view(),
                 b = std::get<const ConvexMesh*>(pair.b)->view();
  collidePolytopes({a, polytopeCore(a), b, polytopeCore(b)}, pair, result);
}

void collideConvexBox(const LocalPair& pair, LocalResult& result) {
  const Polytope a = std::get<const ConvexMesh*>(pair.a)->view();
  const Box& box = std::get<Box>(pair.b);
  const BoxPolytope storage(box.half_extent);
  const Polytope b = storage.view();
  collidePolytopes({a, polytopeCore(a), b, boxCore(box)}, pair, result);
}

}  // namespace pfx
