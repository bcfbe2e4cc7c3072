// Dispatch, separating-axis cache, and the way from the frame of the first shape to body frames.
#include "pfx/base_level/collision/pair_table.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/collision/pair_functions.h"
#include "pfx/base_level/math/finite.h"
#include "pfx/base_level/shape/collidable.h"

namespace pfx {
namespace {

// First shape by row, second by column. Of the two entries of an unequal pair one is set.
constexpr PairFunction kNone = nullptr;
constexpr PairFunction kTable[kNumShapeTypes][kNumShapeTypes] = {
    // Sphere            Box                 Capsule                 Cylinder                 ConvexMesh
    {collideSphereSphere, collideSphereBox, collideSphereCapsule, collideSphereCylinder, kNone,
     kNone},                                                         // Sphere
    {kNone, collideBoxBox, collideBoxCapsule, kNone, kNone, kNone},  // Box
    {kNone, kNone, collideCapsuleCapsule, kNone, kNone, kNone},      // Capsule
    {kNone, collideCylinderBox, collideCylinderCapsule, collideCylinderCylinder, collideCylinderConvex,
     kNone},
    {collideConvexSphere, collideConvexBox, collideConvexCapsule, kNone, collideConvexConvex,
     kNone},                                     // ConvexMesh
    {kNone, kNone, kNone, kNone, kNone, kNone},  // LargeMesh
};

float outerRadius(const Geometry& geometry) {
  struct Visitor {
    float operator()(const Sphere& s) const { return s.radius; }
    float operator()(const Box& b) const { return b.half_extent.norm(); }
    float operator()(const Capsule& c) const { return c.half_length + c.radius; }
    float operator()(const Cylinder& c) const {
      return std::sqrt(c.half_length * c.half_length + c.radius * c.radius);
    }
    float operator()(const ConvexMesh* m) const { return m->outer_radius; }
    float operator()(const LargeMesh*) const { return 1e30f; }
  };
  return std::visit(Visitor{}, geometry);
}

void remember(PairCache& cache, const CollideInput& in, const Transform& b_in_a, const LocalResult& r,
              bool flipped) {
  const Quat& to_a = in.shape_a.offset.orientation;
  cache.hint = r.hint;
  cache.axis = flipped ? b_in_a.orientation * (in.shape_b.offset.orientation * -r.manifold.normal)
                       : to_a * r.manifold.normal;
  cache.separation = PairCache::kUnknown;
  if (r.manifold.num_points > 0 || !(r.separation > in.margin)) return;
  cache.b_in_a = b_in_a;
  cache.separation = r.separation;
  cache.radius_b = outerRadius(in.shape_b.geometry) + in.shape_b.offset.position.norm();
}

void writeManifold(const CollideInput& in, const RelativePose& second_in_first, const LocalManifold& local,
                   bool flipped, ContactManifold& out) {
  const Shape& first = flipped ? in.shape_b : in.shape_a;
  const Shape& second = flipped ? in.shape_a : in.shape_b;
  const Transform& first_body = flipped ? in.body_b : in.body_a;
  const Vec3 normal = first_body.orientation * (first.offset.orientation * local.normal);
  out.normal = flipped ? Vec3(-normal) : normal;
  for (int i = 0; i < local.num_points; ++i) {
    const LocalContact& c = local.points[i];
    const Vec3 on_first = first.offset.apply(c.point_a);
    const Vec3 on_second = second.offset.apply(second_in_first.toB(c.point_b));
    ContactPoint& p = out.points[i];
    p = ContactPoint{};
    p.local_a = flipped ? on_second : on_first;
    p.local_b = flipped ? on_first : on_second;
    p.distance = c.distance;
    p.feature = c.feature;
  }
  out.num_points = local.num_points;
}

}  // namespace

PairFunction pairFunction(ShapeType a, ShapeType b) { return kTable[int(a)][int(b)]; }

bool provablyApart(const PairCache& cache, const Transform& body_b_in_a, float margin) {
  if (cache.separation == PairCache::kUnknown) return false;
  // |q - q'| is twice the sine of a quarter of the angle between them, and the chord at radius r is twice r
  // times the sine of half of it, hence chord <= 2 |q - q'| r; q and -q are the same rotation.
  const auto q = body_b_in_a.orientation.coeffs(), old = cache.b_in_a.orientation.coeffs();
  const float squared = std::min((q - old).squaredNorm(), (q + old).squaredNorm());
  const float turn = 2.0f * std::sqrt(squared) * cache.radius_b;
  const float shift = cache.axis.dot(body_b_in_a.position - cache.b_in_a.position);
  const float rounding = 1e-6f * (cache.radius_b + body_b_in_a.position.cwiseAbs().maxCoeff());
  return cache.separation + shift - turn - rounding > margin;
}

int collideShapes(const CollideInput& in, ContactManifold& out) {
  out.num_points = 0;
  const Transform bodies = relative(in.body_a, in.body_b);
  if (in.cache != nullptr && provablyApart(*in.cache, bodies, in.margin)) return 0;
  if (!isFinite(bodies) || isMissing(in.shape_a.geometry) || isMissing(in.shape_b.geometry)) return 0;

  const bool flipped = pairFunction(in.shape_a.type(), in.shape_b.type()) == nullptr;
  const Shape& first = flipped ? in.shape_b : in.shape_a;
  const Shape& second = flipped ? in.shape_a : in.shape_b;
  const PairFunction collide = pairFunction(first.type(), second.type());
  if (collide == nullptr) return 0;

  const RelativePose b_in_a(relative(in.shape_a.offset, bodies * in.shape_b.offset));
  const RelativePose pose = flipped ? b_in_a.inverse() : b_in_a;
  LocalPair pair{first.geometry, second.geometry, pose, in.margin, 0, Vec3::Zero()};
  if (in.cache != nullptr) {
    pair.hint = in.cache->hint;
    const Vec3 axis = in.shape_a.offset.orientation.conjugate() * in.cache->axis;
    pair.axis = flipped ? Vec3(-(pose.rotation * axis)) : axis;
  }
  LocalResult result;
  collide(pair, result);
  if (in.cache != nullptr) remember(*in.cache, in, bodies, result, flipped);
  writeManifold(in, pose, result.manifold, flipped, out);
  return out.num_points;
}

}  // namespace pfx
