// Conservative advancement over convex cores; a large mesh is asked facet by facet.
#include "pfx/low_level/continuous/time_of_impact.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/mesh_contact.h"
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

// Bounds, in the frame of the mesh at the start, of all that the body can reach.
Aabb sweptBounds(const LargeMesh& mesh, const ImpactInput& in) {
  const Transform to_mesh = relative(in.sweep_a.start * in.shape_a.offset, in.sweep_b.start * in.shape_b.offset);
  const Aabb start = shapeAabb(in.shape_b.geometry, to_mesh);
  const Quat to_local = (in.sweep_a.start.orientation * in.shape_a.offset.orientation).conjugate();
  const Vec3 motion = to_local * (in.sweep_b.motion - in.sweep_a.motion) * in.max_fraction;
  Aabb box = start;
  box.extend(Aabb{start.min + motion, start.max + motion});
  const float reach_b = start.halfExtent().norm() + in.shape_b.offset.position.norm();
  float turn = in.sweep_b.rotation.norm() * reach_b;
  const float mesh_turn = in.sweep_a.rotation.norm();
  if (mesh_turn > 0.0f) {
    const Vec3 apart = in.sweep_b.start.position - in.sweep_a.start.position;
    turn += mesh_turn * (apart.norm() + motion.norm() + reach_b);
  }
  return box.grown(turn + in.tolerance + 1e-5f * (mesh.surface_bounds.halfExtent().norm()));
}

// A is the mesh.
Impact meshImpact(const ImpactInput& in) {
  const LargeMesh& mesh = *std::get<const LargeMesh*>(in.shape_a.geometry);
  Polytope polytope_b;
  const Mover b = makeMover(in.shape_b, in.sweep_b, polytope_b);
  const Transform b_in_mesh = relative(in.sweep_a.start * in.shape_a.offset, b.at(0.0f));
  const Vec3 center = b_in_mesh.apply(b.core.center());
  const bool turns = !in.sweep_a.rotation.isZero(0.0f) || !in.sweep_b.rotation.isZero(0.0f);
  const Quat to_local = (in.sweep_a.start.orientation * in.shape_a.offset.orientation).conjugate();
  const Vec3 motion = to_local * (in.sweep_b.motion - in.sweep_a.motion);

  Impact best;
  const auto tryFacet = [&](uint32_t f) {
    const MeshTriangle t = meshTriangle(mesh, f);
    if (t.normal.dot(center - t.vertex[0]) < -t.thickness) return;
    if (!turns && t.normal.dot(motion) >= 0.0f) return;
    Polytope triangle;
    // The frame of the core is moved to the facet: far from the mesh's origin the search would lose precision.
    std::array<Vec3, 3> corners = {Vec3::Zero(), t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0]};
    triangle.vertices = corners;
    triangle.center = (corners[1] + corners[2]) / 3.0f;
    Mover a{polytopeCore(triangle), in.shape_a.offset * Transform{t.vertex[0], Quat::Identity()}, &in.sweep_a, 0.0f};
    a.reach = turns ? reachOf(a.core, a.offset) : 0.0f;
    Impact impact = advance(a, b, {in.tolerance, std::min(in.max_fraction, best.touches() ? best.fraction : 1.0f)});
    if (!impact.touches()) return;
    impact.triangle = f;
    // Among facets that are met at the same time the lowest counts, in whichever order they are stored.
    const bool earlier = !best.touches() || impact.fraction < best.fraction ||
                         (impact.fraction == best.fraction && mesh.source[f] < mesh.source[best.triangle]);
    if (earlier) best = impact;
  };
  visitFacets(mesh, sweptBounds(mesh, in), [&](uint32_t first, uint32_t count) {
    for (uint32_t f = first; f < first + count; ++f) tryFacet(f);
  });
  return best;
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
