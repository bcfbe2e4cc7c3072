// Conservative advancement over convex cores; a large mesh is asked facet by facet.
#include "pfx/low_level/continuous/time_of_impact.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/math/finite.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/mesh_query.h"

namespace pfx {
namespace {

// More steps than any approach needs that is not grazing; where they do not suffice the last safe time is returned.
constexpr int kMaxSteps = 96;

// A convex core with the way it moves.
struct Mover {
  ConvexCore core;
  Transform offset;  // core to body
  const Sweep* sweep = nullptr;
  float reach = 0.0f;  // m, of a ball around the body's origin that holds the shape

  Transform at(float t) const { return sweep->at(t) * offset; }
};

float reachOf(const ConvexCore& core, const Transform& offset) {
  return core.outerRadius() + core.radius + offset.position.norm();
}

// Fills `polytope`, which the core then refers to, for a convex mesh.
ConvexCore coreOf(const Geometry& geometry, Polytope& polytope) {
  struct Make {
    Polytope& polytope;
    ConvexCore operator()(const Sphere& s) const { return pointCore(s.radius); }
    ConvexCore operator()(const Box& b) const { return boxCore(b); }
    ConvexCore operator()(const Capsule& c) const { return segmentCore(c); }
    ConvexCore operator()(const Cylinder& c) const { return cylinderCore(c); }
    ConvexCore operator()(const ConvexMesh* m) const {
      polytope = m->view();
      return polytopeCore(polytope);
    }
    ConvexCore operator()(const LargeMesh*) const { return pointCore(0.0f); }
  };
  return std::visit(Make{polytope}, geometry);
}

// Greatest rate (m per interval) at which the gap along the unit vector n, from A to B, can shrink. A point at r turns
// towards n at n . (w x r) = r . (n x w) <= |r| |n x w|.
float closingRate(const Mover& a, const Mover& b, const Vec3& n) {
  return n.dot(a.sweep->motion - b.sweep->motion) + a.reach * n.cross(a.sweep->rotation).norm() +
         b.reach * n.cross(b.sweep->rotation).norm();
}

float fastestRate(const Mover& a, const Mover& b) {
  return (a.sweep->motion - b.sweep->motion).norm() + a.reach * a.sweep->rotation.norm() +
         b.reach * b.sweep->rotation.norm();
}

struct Limits {
  float tolerance, max_fraction;
};

Impact advance(const Mover& a, const Mover& b, const Limits& limits) {
  const float radii = a.core.radius + b.core.radius, fastest = fastestRate(a, b);
  Impact impact;
  float t = 0.0f;
  Vec3 axis = Vec3::Zero();
  for (int step = 0; step < kMaxSteps; ++step) {
    const Transform pose_a = a.at(t), pose_b = b.at(t);
    const RelativePose b_in_a(relative(pose_a, pose_b));
    const float out_of_reach = radii + limits.tolerance + 1.01f * fastest * (limits.max_fraction - t);
    const GjkResult gjk = gjkDistance({a.core, b.core, b_in_a, axis, out_of_reach});
    if (gjk.state == GjkResult::State::BeyondLimit) return {};
    if (gjk.state == GjkResult::State::Touching) {
      impact.state = step == 0 ? Impact::State::Overlaps : Impact::State::Hit;
      impact.fraction = t;
      return impact;
    }
    axis = gjk.normal;
    const float gap = gjk.distance - radii;
    impact.normal = pose_a.orientation * gjk.normal;
    impact.point = pose_a.apply(gjk.point_b - b.core.radius * gjk.normal);
    impact.fraction = t;
    const float rate = closingRate(a, b, impact.normal);
    if (gap <= limits.tolerance) {
      // Touching, but on the way apart: no impact.
      if (!(rate > 0.0f)) return {};
      impact.state = step == 0 ? Impact::State::Overlaps : Impact::State::Hit;
      return impact;
    }
    if (!(rate > 0.0f)) return {};
    t += (gap - 0.5f * limits.tolerance) / rate;
    if (!(t <= limits.max_fraction)) return {};
  }
  impact.state = Impact::State::Hit;
  return impact;
}

Mover makeMover(const Shape& shape, const Sweep& sweep, Polytope& polytope) {
  Mover m{coreOf(shape.geometry, polytope), shape.offset, &sweep, 0.0f};
  m.reach = reachOf(m.core, m.offset);
  return m;
}

// The body as seen from a mesh: a ball that holds it however it turns, on its way.
struct BallSweep {
  Vec3 start;     // m, mesh frame, of the body's origin
  Vec3 motion;    // m
  float radius;   // m
  bool straight;  // false: the mesh turns, and the ball only holds the body if it holds all that can happen

  Aabb bounds(float from, float to) const {
    Aabb box;
    box.extend(Vec3(start + from * motion));
    box.extend(Vec3(start + to * motion));
    return box.grown(1.001f * radius);  // not to be outdone by the rounding of enter()
  }

  // Fraction at which the ball's box first meets `box`; above one: never.
  float enter(const Aabb& box) const {
    if (!straight) return 0.0f;
    float first = 0.0f, last = 1.0f;
    for (int a = 0; a < 3; ++a) {
      const float lo = box.min[a] - radius - start[a], hi = box.max[a] + radius - start[a];
      if (motion[a] == 0.0f) {
        if (lo > 0.0f || hi < 0.0f) return 2.0f;
        continue;
      }
      const float t0 = lo / motion[a], t1 = hi / motion[a];
      first = std::max(first, std::min(t0, t1));
      last = std::min(last, std::max(t0, t1));
    }
    return first <= last ? first : 2.0f;
  }
};

BallSweep ballSweep(const LargeMesh& mesh, const ImpactInput& in, const Mover& b) {
  const Transform mesh_pose = in.sweep_a.start * in.shape_a.offset;
  BallSweep ball;
  ball.start = mesh_pose.applyInverse(in.sweep_b.start.position);
  ball.motion = mesh_pose.orientation.conjugate() * (in.sweep_b.motion - in.sweep_a.motion);
  ball.straight = in.sweep_a.rotation.isZero(0.0f);
  // Rounding of all these positions.
  const float slack = 1e-5f * (mesh.surface_bounds.halfExtent().norm() + ball.motion.norm());
  ball.radius = b.reach + in.tolerance + slack;
  if (!ball.straight) {
    const Vec3 apart = in.sweep_b.start.position - in.sweep_a.start.position;
    ball.radius += in.sweep_a.rotation.norm() * (apart.norm() + ball.motion.norm() + b.reach);
  }
  return ball;
}

// One facet after the other, along the way of the body.
class MeshImpact {
 public:
  MeshImpact(const ImpactInput& in, const LargeMesh& mesh)
      : in_(in), mesh_(mesh), b_(makeMover(in.shape_b, in.sweep_b, polytope_b_)), ball_(ballSweep(mesh, in, b_)) {
    center_ = relative(in.sweep_a.start * in.shape_a.offset, b_.at(0.0f)).apply(b_.core.center());
    turns_ = !in.sweep_a.rotation.isZero(0.0f) || !in.sweep_b.rotation.isZero(0.0f);
  }

  Impact find() {
    // Pieces about as long as the body, so that a long way through a fine mesh looks only at what lies near it.
    const float pieces = ball_.straight ? std::ceil(ball_.motion.norm() / (4.0f * ball_.radius)) : 1.0f;
    const int n = static_cast<int>(std::clamp(pieces, 1.0f, 256.0f));
    for (int i = 0; i < n; ++i) {
      const float from = static_cast<float>(i) / static_cast<float>(n);
      const float to = static_cast<float>(i + 1) / static_cast<float>(n);
      if (from > in_.max_fraction || (best_.touches() && from > best_.fraction)) break;
      visitFacets(mesh_, ball_.bounds(from, to), [&](uint32_t first, uint32_t count) {
        for (uint32_t f = first; f < first + count; ++f) tryFacet(f, from, i + 1 < n ? to : 2.0f);
      });
    }
    return best_;
  }

 private:
  // Facets belong to the piece in which the ball first meets their bounds.
  void tryFacet(uint32_t f, float from, float to) {
    const auto v = facetVertices(mesh_, f);
    Aabb box;
    for (const Vec3& p : v) box.extend(p);
    const float enter = ball_.enter(box);
    const float limit = std::min(in_.max_fraction, best_.fraction);
    if (enter < from || enter >= to || enter > limit) return;
    const MeshTriangle t = meshTriangle(mesh_, f);
    if (t.normal.dot(center_ - v[0]) < -t.thickness) return;
    if (!turns_ && t.normal.dot(ball_.motion) >= 0.0f) return;
    // The frame of the core is moved to the facet: far from the mesh's origin the search would lose precision.
    const std::array<Vec3, 3> corners = {Vec3::Zero(), v[1] - v[0], v[2] - v[0]};
    Polytope triangle;
    triangle.vertices = corners;
    triangle.center = (corners[1] + corners[2]) / 3.0f;
    Mover a{polytopeCore(triangle), in_.shape_a.offset * Transform{v[0], Quat::Identity()}, &in_.sweep_a, 0.0f};
    a.reach = turns_ ? reachOf(a.core, a.offset) : 0.0f;
    Impact impact = advance(a, b_, {in_.tolerance, limit});
    if (!impact.touches()) return;
    impact.triangle = f;
    // Among facets that are met at the same time the lowest counts, in whichever order they are stored.
    const bool earlier = !best_.touches() || impact.fraction < best_.fraction ||
                         (impact.fraction == best_.fraction && mesh_.source[f] < mesh_.source[best_.triangle]);
    if (earlier) best_ = impact;
  }

  const ImpactInput& in_;
  const LargeMesh& mesh_;
  Polytope polytope_b_;
  Mover b_;
  BallSweep ball_;
  Vec3 center_;   // m, of the body at the start, mesh frame
  bool turns_;
  Impact best_;
};

bool isFinite(const Sweep& s) { return pfx::isFinite(s.start) && pfx::isFinite(s.motion) && pfx::isFinite(s.rotation); }

// A is the mesh.
Impact meshImpact(const ImpactInput& in) {
  return MeshImpact(in, *std::get<const LargeMesh*>(in.shape_a.geometry)).find();
}

}  // namespace

Transform Sweep::at(float fraction) const {
  Transform pose{start.position + fraction * motion, start.orientation};
  if (!rotation.isZero(0.0f)) pose.orientation = (expMap(fraction * rotation) * start.orientation).normalized();
  return pose;
}

Impact timeOfImpact(const ImpactInput& in) {
  const bool mesh_a = in.shape_a.type() == ShapeType::LargeMesh, mesh_b = in.shape_b.type() == ShapeType::LargeMesh;
  if (mesh_a && mesh_b) return {};
  if (isMissing(in.shape_a.geometry) || isMissing(in.shape_b.geometry)) return {};
  if (!isFinite(in.sweep_a) || !isFinite(in.sweep_b)) return {};
  if (mesh_a) return meshImpact(in);
  if (mesh_b) {
    Impact impact = meshImpact({in.shape_b, in.sweep_b, in.shape_a, in.sweep_a, in.tolerance, in.max_fraction});
    impact.normal = -impact.normal;
    return impact;
  }
  Polytope polytope_a, polytope_b;
  return advance(makeMover(in.shape_a, in.sweep_a, polytope_a), makeMover(in.shape_b, in.sweep_b, polytope_b),
                 {in.tolerance, in.max_fraction});
}

}  // namespace pfx
