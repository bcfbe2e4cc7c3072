// Capsule against capsule, box and convex mesh. A capsule that lies along its partner gets two points, else
// one.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_reduction.h"
#include "pfx/base_level/collision/pair_functions.h"
#include "pfx/base_level/collision/segment_polytope.h"

namespace pfx {
namespace {

// Segments count as parallel below this squared sine (three degrees); capsules then touch along a line.
constexpr float kParallelSquaredSine = 0.0027f;

// Segments that cross this close, as a fraction of the size, get the normal of their common plane; the
// direction between the closest points would be mostly rounding.
constexpr float kCrossing = 1e-3f;

Vec3 crossNormal(const Vec3& axis_a, const Vec3& axis_b, const Vec3& toward) {
  Vec3 n = axis_a.cross(axis_b);
  n = n.squaredNorm() > 1e-8f ? Vec3(n.normalized()) : tangents(axis_a).t1;
  return n.dot(toward) < 0.0f ? Vec3(-n) : n;
}

bool isInner(float fraction) { return fraction > 0.0f && fraction < 1.0f; }

}  // namespace

void collideCapsuleCapsule(const LocalPair& pair, LocalResult& result) {
  const Capsule &a = std::get<Capsule>(pair.a), &b = std::get<Capsule>(pair.b);
  const Vec3 axis_a = Vec3::UnitX(), axis_b = pair.b_in_a.rotation.col(0);
  const Vec3 center_b = pair.b_in_a.position;
  const Vec3 a0 = -a.half_length * axis_a, a1 = a.half_length * axis_a;
  const Vec3 b0 = center_b - b.half_length * axis_b, b1 = center_b + b.half_length * axis_b;
  const SegmentPair at = closestOnSegments(a0, a1, b0, b1);
  const Vec3 p = a0 + at.s * (a1 - a0), q = b0 + at.t * (b1 - b0);
  const float radius = a.radius + b.radius;
  const float length = (q - p).norm();
  LocalManifold& m = result.manifold;
  const float size = std::max(a.half_length + a.radius, b.half_length + b.radius);
  const bool crossing = length < kCrossing * size && isInner(at.s) && isInner(at.t);
  m.normal =
      crossing || !(length > 1e-6f * size) ? crossNormal(axis_a, axis_b, q - p) : Vec3((q - p) / length);
  const float distance = length - radius;
  if (distance > pair.margin) {
    result.separation = distance;
    return;
  }
  const auto addAt = [&](const Vec3& on_a, const Vec3& on_b, uint32_t id) {
    const LocalContact c =
        oppositePoints(on_a + a.radius * m.normal, on_b - b.radius * m.normal, m.normal, id);
    if (c.distance <= pair.margin) m.add(c);
  };

  // Side by side: the ends of the stretch of B that lies beside A. Distances are taken along the normal, so
  // the point on A is the foot of the point on B.
  const float squared_sine = axis_b.tail<2>().squaredNorm();
  const bool beside = std::abs(m.normal.x()) < 0.05f;
  if (squared_sine < kParallelSquaredSine && beside) {
    const float slope = axis_b.x();
    const float u0 = (-a.half_length - center_b.x()) / slope, u1 = (a.half_length - center_b.x()) / slope;
    const float lo = std::max(std::min(u0, u1), -b.half_length),
                hi = std::min(std::max(u0, u1), b.half_length);
    if (hi - lo > 1e-3f * size) {
      for (const auto& [u, id] : {std::pair(lo, 2u), std::pair(hi, 3u)}) {
        const Vec3 on_b = center_b + u * axis_b;
        const Vec3 on_a(std::clamp(on_b.x(), -a.half_length, a.half_length), 0.0f, 0.0f);
        addAt(on_a, on_b, id);
      }
      if (m.num_points > 0) return;
    }
  }
  m.add({p + a.radius * m.normal, q - b.radius * m.normal, distance, 1});
}

void collideBoxCapsule(const LocalPair& pair, LocalResult& result) {
  const Box& box = std::get<Box>(pair.a);
  const BoxPolytope storage(box.half_extent);
  const Polytope polytope = storage.view();
  collidePolytopeCapsule(polytope, boxCore(box), std::get<Capsule>(pair.b), pair, result);
}

void collideConvexCapsule(const LocalPair& pair, LocalResult& result) {
  const Polytope polytope = std::get<const ConvexMesh*>(pair.a)->view();
  collidePolytopeCapsule(polytope, polytopeCore(polytope), std::get<Capsule>(pair.b), pair, result);
}

void collideConvexSphere(const LocalPair& pair, LocalResult& result) {
  const Polytope polytope = std::get<const ConvexMesh*>(pair.a)->view();
  const Capsule ball{0.0f, std::get<Sphere>(pair.b).radius};
  collidePolytopeCapsule(polytope, polytopeCore(polytope), ball, pair, result);
}

}  // namespace pfx
