#include "pfx/low_level/collision/body_pair.h"

#include <algorithm>
#include <cmath>

#include "pfx/low_level/broadphase/shape_tree.h"
#include "pfx/low_level/collision/merge_manifolds.h"

namespace pfx {
namespace {

bool isMesh(const Shape& shape) { return shape.type() == ShapeType::LargeMesh; }

// Whether a body can roll on the surface of this shape that looks along the normal: a cylinder not on its
// caps.
bool rollsOn(const Shape& shape, const Transform& body, const Vec3& normal) {
  if (shape.type() == ShapeType::Sphere || shape.type() == ShapeType::Capsule) return true;
  constexpr float kOnCap = 0.9999f;
  return shape.type() == ShapeType::Cylinder &&
         std::abs(normal.dot(body.orientation * (shape.offset.orientation * Vec3::UnitX()))) < kOnCap;
}

// Whether a mesh gave the contact a normal that is not that of its facet.
bool leansOn(const Shape& mesh_shape, const Transform& mesh_body, const ContactManifold& m) {
  constexpr float kOwn =
      0.9999f;  // a contact lies within half a degree of the normal, or takes it as its own
  const LargeMesh& mesh = *std::get<const LargeMesh*>(mesh_shape.geometry);
  const Vec3 facet = meshTriangle(mesh, m.points[0].triangle).normal;
  return std::abs(m.normal.dot(mesh_body.orientation * (mesh_shape.offset.orientation * facet))) < kOwn;
}

// Appends the manifolds of one shape of A and one of B.
void collideOne(const CollideInput& input, MeshContactScratch& mesh_scratch, FoundManifolds& out) {
  const size_t first = out.manifolds.size();
  if (isMesh(input.shape_a) || isMesh(input.shape_b)) {
    collideMesh(input, mesh_scratch, out.manifolds);
  } else {
    ContactManifold m;
    if (collideShapes(input, m) > 0) out.manifolds.push_back(m);
  }
  for (const ContactManifold& m : std::span(out.manifolds).subspan(first)) {
    out.rolls = out.rolls || rollsOn(input.shape_a, input.body_a, m.normal) ||
                rollsOn(input.shape_b, input.body_b, m.normal);
    out.leans = out.leans || (isMesh(input.shape_a) && leansOn(input.shape_a, input.body_a, m)) ||
                (isMesh(input.shape_b) && leansOn(input.shape_b, input.body_b, m));
  }
}

// Manifolds of compounds: the shapes of the body that has fewer are looked up among those of the other.
void collideParts(const BodyPair& p, MeshContactScratch& mesh_scratch, FoundManifolds& out) {
  const auto shapes_a = p.a.shapes(), shapes_b = p.b.shapes();
  const auto collide = [&](uint32_t i, uint32_t j) {
    const size_t first = out.manifolds.size();
    collideOne({shapes_a[i], p.pose_a, shapes_b[j], p.pose_b, p.margin, nullptr}, mesh_scratch, out);
    // Features of different parts must not be mistaken for each other.
    for (ContactManifold& m : std::span(out.manifolds).subspan(first))
      for (int k = 0; k < m.num_points; ++k) m.points[k].feature ^= ((i << 16 ^ j) + 1) * 0x9e3779b1u;
  };
  const bool a_is_larger = shapes_a.size() >= shapes_b.size();
  const Collidable &few = a_is_larger ? p.b : p.a, &many = a_is_larger ? p.a : p.b;
  const Transform few_in_many = a_is_larger ? relative(p.pose_a, p.pose_b) : relative(p.pose_b, p.pose_a);
  const Transform many_in_few = a_is_larger ? relative(p.pose_b, p.pose_a) : relative(p.pose_a, p.pose_b);
  visitShapes(few, transformedAabb(many_in_few, many.center, many.half_extent).grown(p.margin),
              [&](uint32_t f) {
                const Shape& shape = few.shapes()[f];
                const Aabb box = shapeAabb(shape.geometry, few_in_many * shape.offset).grown(p.margin);
                visitShapes(many, box, [&](uint32_t m) { a_is_larger ? collide(m, f) : collide(f, m); });
              });
}

}  // namespace

bool hasMesh(const Collidable& c) { return std::ranges::any_of(c.shapes(), isMesh); }

void collideBodies(const BodyPair& p, PairCache& cache, MeshContactScratch& mesh_scratch,
                   FoundManifolds& out) {
  const auto shapes_a = p.a.shapes(), shapes_b = p.b.shapes();
  const bool single = shapes_a.size() == 1 && shapes_b.size() == 1;
  if (single)
    collideOne({shapes_a[0], p.pose_a, shapes_b[0], p.pose_b, p.margin, &cache}, mesh_scratch, out);
  else
    collideParts(p, mesh_scratch, out);
  for (ContactManifold& m : out.manifolds) m.local_normal = p.pose_a.orientation.conjugate() * m.normal;
  if (!single && out.manifolds.size() > 1)
    mergeManifolds(relative(p.pose_a, p.pose_b), mesh_scratch.parts, out.manifolds);
}

}  // namespace pfx
