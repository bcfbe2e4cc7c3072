// Box against box: separating axes (S. Gottschalk et al., OBBTree, SIGGRAPH 1996), then clipping of the two
// faces or the closest points of two edges.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_clipping.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/pair_functions.h"

namespace pfx {
namespace {

// An axis must beat a face of A, and an edge axis must beat a face, by this fraction of the boxes' size: the
// choice among equally good axes must not depend on rounding.
constexpr float kPreference = 5e-6f;
// The axis of the last frame is kept until another one beats it by this fraction of the smaller box.
constexpr float kHysteresis = 1e-3f;
// Below this gap, as a fraction of the boxes' size, the direction between the closest points is mostly
// rounding.
constexpr float kNear = 1e-4f;

struct Axis {
  float separation = -1e30f;
  int code = 0;                 // 1..3 face of A, 4..6 face of B, 7 + 3 i + j: edge i of A x edge j of B
  Vec3 normal = Vec3::UnitY();  // A to B
};

Axis faceAxisA(int i, const Vec3& ha, const Vec3& hb, const RelativePose& b) {
  const float reach = ha[i] + b.rotation.row(i).cwiseAbs().dot(hb.transpose());
  Vec3 n = Vec3::Zero();
  n[i] = b.position[i] < 0.0f ? -1.0f : 1.0f;
  return {std::abs(b.position[i]) - reach, 1 + i, n};
}

Axis faceAxisB(int j, const Vec3& ha, const Vec3& hb, const RelativePose& b) {
  const Vec3 n = b.rotation.col(j);
  const float along = n.dot(b.position);
  return {std::abs(along) - hb[j] - n.cwiseAbs().dot(ha), 4 + j, along < 0.0f ? Vec3(-n) : n};
}

// Nearly parallel edges have no axis of their own (code 0).
Axis edgeAxis(int i, int j, const Vec3& ha, const Vec3& hb, const RelativePose& b) {
  const Mat3& r = b.rotation;
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  const float squared = r(i1, j) * r(i1, j) + r(i2, j) * r(i2, j);
  if (squared < 1e-6f) return {};
  const float scale = 1.0f / std::sqrt(squared);
  Vec3 n = Vec3::Zero();  // e_i x column j
  n[i1] = -r(i2, j) * scale;
  n[i2] = r(i1, j) * scale;
  const float along = n.dot(b.position);
  if (along < 0.0f) n = -n;
  const Vec3 n_b = b.rotateToB(n);
  return {std::abs(along) - n.cwiseAbs().dot(ha) - n_b.cwiseAbs().dot(hb), 7 + 3 * i + j, n};
}

Axis axisOfCode(int code, const Vec3& ha, const Vec3& hb, const RelativePose& b) {
  if (code >= 1 && code <= 3) return faceAxisA(code - 1, ha, hb, b);
  if (code >= 4 && code <= 6) return faceAxisB(code - 4, ha, hb, b);
  if (code >= 7 && code <= 15) return edgeAxis((code - 7) / 3, (code - 7) % 3, ha, hb, b);
  return {};
}

// Stops at the first axis that separates the boxes by more than the margin.
Axis bestAxis(const Vec3& ha, const Vec3& hb, const RelativePose& b, float margin) {
  const float preference = kPreference * (ha.sum() + hb.sum());
  Axis best;
  for (int i = 0; i < 3; ++i) {
    const Axis axis = faceAxisA(i, ha, hb, b);
    if (axis.separation > best.separation) best = axis;
  }
  if (best.separation > margin) return best;
  Axis best_b;
  for (int j = 0; j < 3; ++j) {
    const Axis axis = faceAxisB(j, ha, hb, b);
    if (axis.separation > best_b.separation) best_b = axis;
  }
  if (best_b.separation > best.separation + preference) best = best_b;
  if (best.separation > margin) return best;
  Axis best_edge;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Axis axis = edgeAxis(i, j, ha, hb, b);
      if (axis.separation > best_edge.separation) best_edge = axis;
    }
  }
  return best_edge.separation > best.separation + preference ? best_edge : best;
}

void faceContact(const Axis& axis, const BoxPolytope& a, const BoxPolytope& b, const LocalPair& pair,
                 LocalManifold& m) {
  const Polytope pa = a.view(), pb = b.view();
  ContactPolygon face_a, face_b;
  loadFace(pa, supportingFace(pa, axis.normal), face_a);
  loadFace(pb, supportingFace(pb, -pair.b_in_a.rotateToB(axis.normal)), pair.b_in_a, face_b);
  const bool a_is_reference = axis.code <= 3;
  if (a_is_reference) {
    clipFaces({face_a, face_b, true, pair.margin}, m);
  } else {
    clipFaces({face_b, face_a, false, pair.margin}, m);
  }
}

// The two edges that support the axis: half extents along the edge, signs of the axis across it. Returns the
// distance of their closest points.
float edgeContact(const Axis& axis, const Vec3& ha, const Vec3& hb, const LocalPair& pair, LocalManifold& m) {
  const int i = (axis.code - 7) / 3, j = (axis.code - 7) % 3;
  const Vec3 n_b = -pair.b_in_a.rotateToB(axis.normal);
  Vec3 a0 = ha, b0 = hb;
  uint32_t signs = 0;
  for (int k = 0; k < 3; ++k) {
    if (axis.normal[k] < 0.0f) a0[k] = -a0[k], signs |= 1u << k;
    if (n_b[k] < 0.0f) b0[k] = -b0[k], signs |= 8u << k;
  }
  signs &= ~(1u << i | 8u << j);
  Vec3 a1 = a0, b1 = b0;
  a0[i] = -ha[i], a1[i] = ha[i];
  b0[j] = -hb[j], b1[j] = hb[j];
  b0 = pair.b_in_a.toA(b0);
  b1 = pair.b_in_a.toA(b1);
  const SegmentPair at = closestOnSegments(a0, a1, b0, b1);
  const Vec3 p = a0 + at.s * (a1 - a0), q = b0 + at.t * (b1 - b0);
  m.add(oppositePoints(p, q, axis.normal, uint32_t(axis.code) << 8 | signs));
  return (q - p).norm();
}

// Corner or edge against edge: the closest points lie on no face.
void closestPoints(const Box& a, const Box& b, const Axis& axis, const LocalPair& pair, LocalResult& result) {
  const GjkResult gjk = gjkDistance({boxCore(a), boxCore(b), pair.b_in_a, axis.normal, pair.margin});
  if (gjk.state == GjkResult::State::Touching) {
    // Rounding clipped everything away although the boxes meet: the deepest corner of B stands for the patch.
    const Vec3 q = pair.b_in_a.toA(boxCore(b).support(-pair.b_in_a.rotateToB(axis.normal)).point);
    result.manifold.add({q - axis.separation * axis.normal, q, axis.separation, 1});
    return;
  }
  result.manifold.normal = gjk.normal;
  if (gjk.state == GjkResult::State::BeyondLimit || gjk.distance > pair.margin) {
    result.separation = gjk.distance;
    return;
  }
  result.manifold.add({gjk.point_a, gjk.point_b, gjk.distance, 1});
}

}  // namespace

void collideBoxBox(const LocalPair& pair, LocalResult& result) {
  const Box &a = std::get<Box>(pair.a), &b = std::get<Box>(pair.b);
  const Vec3 &ha = a.half_extent, &hb = b.half_extent;
  Axis axis = bestAxis(ha, hb, pair.b_in_a, pair.margin);
  result.manifold.normal = axis.normal;
  if (axis.separation > pair.margin) {
    result.separation = axis.separation;
    result.hint = uint32_t(axis.code);
    return;
  }
  const Axis last = axisOfCode(int(pair.hint), ha, hb, pair.b_in_a);
  const float hysteresis = kHysteresis * std::min(ha.minCoeff(), hb.minCoeff());
  // An edge axis gives one point, so it does not hold up the change to a face.
  const bool may_stay = last.code != 0 && (last.code <= 6 || axis.code > 6);
  if (may_stay && last.separation > axis.separation - hysteresis) axis = last;

  result.hint = uint32_t(axis.code);
  result.manifold.normal = axis.normal;
  float reached;  // by the points; the axis is right for a gap when it is the gap
  if (axis.code <= 6) {
    faceContact(axis, BoxPolytope(ha), BoxPolytope(hb), pair, result.manifold);
    reached = deepest(result.manifold);
  } else {
    reached = edgeContact(axis, ha, hb, pair, result.manifold);
  }
  const float near = kNear * (ha.minCoeff() + hb.minCoeff());
  const bool corner =
      axis.separation > near && reached > axis.separation + kPreference * (ha.sum() + hb.sum());
  if (corner) result.manifold.num_points = 0;
  if (result.manifold.num_points == 0) closestPoints(a, b, axis, pair, result);
}

}  // namespace pfx
