// Cylinder against box, capsule, cylinder and convex mesh. A cap gives a face-like patch, the side a line, a
// rim one point; the axis comes from the closest points, or with an overlap from a descent.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_reduction.h"
#include "pfx/base_level/collision/feature_contacts.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/overlap_descent.h"
#include "pfx/base_level/collision/pair_functions.h"

namespace pfx {
namespace {

constexpr float kCapCosine =
    0.8f;  // of the angle between the contact normal and the axis: a cap faces the other shape
constexpr float kSideCosine = 0.3f;  // below: the side does
constexpr float kNear = 1e-4f;       // of the size; see polytope_pair.cpp
constexpr float kSameDepth = 1e-5f;  // of the size: depths that count as equal
constexpr float kRounding = 4e-7f;   // of the distance of the corner that a depth is measured from
constexpr float kSnap = 2e-6f;       // of the size: how much less gap a feature's own normal may have

bool hasCap(float cosine) { return std::abs(cosine) > kCapCosine; }
bool hasSide(float cosine) { return std::abs(cosine) < kSideCosine; }

ContactDisc cap(const Cylinder& c, const RelativePose& pose, float cosine) {
  const float sign = cosine < 0.0f ? -1.0f : 1.0f;
  const Vec3 normal = sign * pose.rotation.col(0);
  return {pose.position + c.half_length * normal,
          normal,
          pose.rotation.col(1),
          pose.rotation.col(2),
          c.radius,
          cosine < 0.0f ? 1u : 2u};
}

// The line on a round surface around `axis` that lies farthest along `direction`.
ContactSegment sideLine(const RelativePose& pose, float half_length, float radius, const Vec3& direction) {
  const Vec3 axis = pose.rotation.col(0);
  const Vec3 outward = (direction - direction.dot(axis) * axis).normalized();
  const Vec3 middle = pose.position + radius * outward;
  return {middle - half_length * axis, middle + half_length * axis, 4};
}

struct Candidates {
  static constexpr int kCapacity = 64;
  Vec3 axes[kCapacity];
  int count = 0;

  void add(const Vec3& n) {
    const float length = n.norm();
    if (length > 1e-6f && count < kCapacity) axes[count++] = n / length;
  }
  void addBoth(const Vec3& n) { add(n), add(-n); }
  std::span<const Vec3> all() const { return {axes, size_t(count)}; }
};

struct CylinderPair {
  const Cylinder& cylinder;  // shape A
  ConvexCore a, b;
  const LocalPair& pair;
  const Polytope* polytope = nullptr;  // of B, if it has one
};

// Axes of overlaps that have a name: caps, the side toward B, faces of B, and the side across the edges of B.
void collectAxes(const CylinderPair& p, Candidates& c) {
  const RelativePose& pose = p.pair.b_in_a;
  c.addBoth(Vec3::UnitX());
  const Vec3 toward = pose.toA(p.b.center());
  c.add(toward);
  c.add(Vec3(0.0f, toward.y(), toward.z()));
  c.addBoth(Vec3::UnitY());
  if (p.polytope == nullptr) {
    const Vec3 axis_b = pose.rotation.col(0);
    c.addBoth(axis_b);
    c.add(toward - toward.dot(axis_b) * axis_b);
    c.addBoth(Vec3::UnitX().cross(axis_b));
  }
}

// Best of the named axes of a polytope, whatever its number of faces.
Vec3 bestPolytopeAxis(const CylinderPair& p) {
  const RelativePose& pose = p.pair.b_in_a;
  Vec3 best = Vec3::UnitX();
  float separation = -1e30f;
  const auto consider = [&](const Vec3& n) {
    const float s = separationAlong(p.a, p.b, pose, n);
    if (s > separation) separation = s, best = n;
  };
  for (const Plane& plane : p.polytope->planes) consider(pose.rotation * -plane.normal);
  for (const PolytopeEdge& e : p.polytope->edges) {
    const Vec3 along = pose.rotation * (p.polytope->vertices[e.v1] - p.polytope->vertices[e.v0]);
    Vec3 n(0.0f, -along.z(), along.y());  // the cylinder's axis x along
    const float length = n.norm();
    if (!(length > 1e-4f * along.norm())) continue;
    n /= length;
    const Vec3 outward =
        pose.rotation * (p.polytope->planes[e.left].normal + p.polytope->planes[e.right].normal);
    consider(n.dot(outward) > 0.0f ? Vec3(-n) : n);
  }
  return best;
}

CoreAxis overlapAxis(const CylinderPair& p) {
  Candidates candidates;
  collectAxes(p, candidates);
  if (p.polytope != nullptr) candidates.add(bestPolytopeAxis(p));
  return leastOverlap(p.a, p.b, p.pair.b_in_a, candidates.all());
}

// Where a face or cap is as good an axis as the one found, its own normal is exact and steady.
void snapNormal(const CylinderPair& p, float size, CoreAxis& axis) {
  const RelativePose& pose = p.pair.b_in_a;
  const float needed = axis.separation - kSnap * (size + std::abs(axis.separation));
  const auto trySnap = [&](const Vec3& n) {
    if (n.dot(axis.normal) < 0.99f) return false;
    const float separation = separationAlong(p.a, p.b, pose, n);
    if (separation < needed) return false;
    axis.normal = n;
    axis.separation = separation;
    return true;
  };
  if (p.polytope != nullptr) {
    const uint32_t face = supportingFace(*p.polytope, -pose.rotateToB(axis.normal));
    if (trySnap(pose.rotation * -p.polytope->planes[face].normal)) return;
  }
  if (trySnap(axis.normal.x() < 0.0f ? Vec3(-Vec3::UnitX()) : Vec3::UnitX())) return;
  if (p.b.kind != ConvexCore::Kind::Cylinder) return;
  const Vec3 axis_b = pose.rotation.col(0);
  trySnap(axis_b.dot(axis.normal) < 0.0f ? Vec3(-axis_b) : axis_b);
}

// Finds the axis; false when the shapes are farther apart than the margin.
bool findAxis(const CylinderPair& p, CoreAxis& axis, LocalResult& result) {
  const float radius = p.b.radius;
  const GjkResult gjk = gjkDistance({p.a, p.b, p.pair.b_in_a, p.pair.axis, radius + p.pair.margin});
  result.manifold.normal = gjk.normal;
  if (gjk.state == GjkResult::State::BeyondLimit || gjk.distance - radius > p.pair.margin) {
    result.separation = gjk.distance - radius;
    return false;
  }
  const float size = std::min(p.cylinder.half_length, p.cylinder.radius);
  if (gjk.state == GjkResult::State::Separated && gjk.distance > kNear * size) {
    axis = {gjk.normal, gjk.distance, gjk.point_a, gjk.point_b};
  } else {
    axis = overlapAxis(p);
  }
  snapNormal(p, size, axis);
  result.manifold.normal = axis.normal;
  return true;
}

// farthest: m, of the corners that depths are measured from. A coin on a floor of a kilometre has depths that are known to
// the rounding of the floor's corners.
ContactCollector collector(const CylinderPair& p, const CoreAxis& axis, float farthest = 0.0f) {
  const float tolerance = kSameDepth * (p.cylinder.half_length + p.cylinder.radius) + kRounding * farthest;
  return {axis.normal, {axis.separation - p.b.radius, p.pair.margin, tolerance}};
}

void finish(const CylinderPair& p, const CoreAxis& axis, ContactCollector& contacts, LocalManifold& m) {
  contacts.ensureDepth(axis.point_a, axis.point_b - p.b.radius * axis.normal);
  reduceContacts(contacts.contacts(), m);
}

void collideCylinderPolytope(const CylinderPair& p, LocalResult& result) {
  CoreAxis axis;
  if (!findAxis(p, axis, result)) return;
  const Vec3& n = axis.normal;
  const RelativePose& pose = p.pair.b_in_a;
  ContactPolygon face;
  const Vec3 to_b = -pose.rotateToB(n);
  loadFace(*p.polytope, supportingFaceAt(*p.polytope, to_b, p.b.support(to_b).id), pose, face);
  ContactCollector contacts = collector(p, axis, face.vertices[0].norm());
  if (-face.normal.dot(n) > kCapCosine) {
    if (hasCap(n.x())) contacts.discFace(cap(p.cylinder, {}, n.x()), face);
    if (hasSide(n.x()))
      contacts.segmentFace(sideLine({}, p.cylinder.half_length, p.cylinder.radius, n), face);
  }
  finish(p, axis, contacts, result.manifold);
}

}  // namespace

void collideCylinderBox(const LocalPair& pair, LocalResult& result) {
  const Cylinder& cylinder = std::get<Cylinder>(pair.a);
  const Box& box = std::get<Box>(pair.b);
  const BoxPolytope storage(box.half_extent);
  const Polytope polytope = storage.view();
  collideCylinderPolytope({cylinder, cylinderCore(cylinder), boxCore(box), pair, &polytope}, result);
}

void collideCylinderConvex(const LocalPair& pair, LocalResult& result) {
  const Cylinder& cylinder = std::get<Cylinder>(pair.a);
  const Polytope polytope = std::get<const ConvexMesh*>(pair.b)->view();
  collideCylinderPolytope({cylinder, cylinderCore(cylinder), polytopeCore(polytope), pair, &polytope},
                          result);
}

void collideCylinderCapsule(const LocalPair& pair, LocalResult& result) {
  const Cylinder& cylinder = std::get<Cylinder>(pair.a);
  const Capsule& capsule = std::get<Capsule>(pair.b);
  const CylinderPair p{cylinder, cylinderCore(cylinder), segmentCore(capsule), pair};
  CoreAxis axis;
  if (!findAxis(p, axis, result)) return;
  const Vec3& n = axis.normal;
  ContactCollector contacts = collector(p, axis);
  if (hasSide(n.dot(pair.b_in_a.rotation.col(0)))) {
    // The lowest line of the capsule is its core moved down along the normal.
    const Vec3 middle = pair.b_in_a.position - capsule.radius * n,
               half = capsule.half_length * pair.b_in_a.rotation.col(0);
    const ContactSegment line{middle - half, middle + half, 4};
    if (hasCap(n.x())) contacts.discSegment(cap(cylinder, {}, n.x()), line, true);
    if (hasSide(n.x())) contacts.segmentSegment(sideLine({}, cylinder.half_length, cylinder.radius, n), line);
  }
  finish(p, axis, contacts, result.manifold);
}

void collideCylinderCylinder(const LocalPair& pair, LocalResult& result) {
  const Cylinder &a = std::get<Cylinder>(pair.a), &b = std::get<Cylinder>(pair.b);
  const CylinderPair p{a, cylinderCore(a), cylinderCore(b), pair};
  CoreAxis axis;
  if (!findAxis(p, axis, result)) return;
  const Vec3& n = axis.normal;
  const RelativePose& pose = pair.b_in_a;
  const float cosine_b = -n.dot(pose.rotation.col(0));
  ContactCollector contacts = collector(p, axis);
  if (hasCap(n.x()) && hasCap(cosine_b)) contacts.discDisc(cap(a, {}, n.x()), cap(b, pose, cosine_b));
  if (hasCap(n.x()) && hasSide(cosine_b)) {
    contacts.discSegment(cap(a, {}, n.x()), sideLine(pose, b.half_length, b.radius, -n), true);
  }
  if (hasSide(n.x()) && hasCap(cosine_b)) {
    contacts.discSegment(cap(b, pose, cosine_b), sideLine({}, a.half_length, a.radius, n), false);
  }
  if (hasSide(n.x()) && hasSide(cosine_b)) {
    contacts.segmentSegment(sideLine({}, a.half_length, a.radius, n),
                            sideLine(pose, b.half_length, b.radius, -n));
  }
  finish(p, axis, contacts, result.manifold);
}

}  // namespace pfx
