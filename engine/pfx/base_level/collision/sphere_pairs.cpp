// Sphere against sphere, box, capsule and cylinder: closed forms, one point each.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/pair_functions.h"

namespace pfx {
namespace {

// One point between the surface of a rounded core B at `q` (closest core point, frame of A) and a sphere A at
// the origin.
void roundedPoint(float radius_a, const Vec3& q, float radius_b, float margin, const Vec3& fallback,
                  LocalResult& result) {
  const float length = q.norm();
  const float distance = length - radius_a - radius_b;
  LocalManifold& m = result.manifold;
  m.normal = length > 0.0f ? Vec3(q / length) : fallback;
  if (distance > margin) {
    result.separation = distance;
    return;
  }
  m.add({radius_a * m.normal, q - radius_b * m.normal, distance, 1});
}

}  // namespace

void collideSphereSphere(const LocalPair& pair, LocalResult& result) {
  const float ra = std::get<Sphere>(pair.a).radius, rb = std::get<Sphere>(pair.b).radius;
  roundedPoint(ra, pair.b_in_a.position, rb, pair.margin, Vec3::UnitY(), result);
}

void collideSphereCapsule(const LocalPair& pair, LocalResult& result) {
  const float ra = std::get<Sphere>(pair.a).radius;
  const Capsule& capsule = std::get<Capsule>(pair.b);
  const Vec3 axis = pair.b_in_a.rotation.col(0);
  const float x = std::clamp(-axis.dot(pair.b_in_a.position), -capsule.half_length, capsule.half_length);
  const Vec3 q = pair.b_in_a.position + x * axis;
  roundedPoint(ra, q, capsule.radius, pair.margin, pair.b_in_a.rotation.col(1), result);
}

void collideSphereBox(const LocalPair& pair, LocalResult& result) {
  const float radius = std::get<Sphere>(pair.a).radius;
  const Vec3& h = std::get<Box>(pair.b).half_extent;
  const Vec3 c = pair.b_in_a.toB(Vec3::Zero());  // centre of the sphere, frame of the box
  const Vec3 q = c.cwiseMax(-h).cwiseMin(h);
  const float outside = (c - q).norm();
  LocalManifold& m = result.manifold;
  // A centre closer to the surface than its rounding counts as inside, where the normal is that of the
  // nearest face.
  if (outside > 1e-6f * h.maxCoeff()) {
    m.normal = pair.b_in_a.rotation * ((q - c) / outside);
    const float distance = outside - radius;
    if (distance > pair.margin) {
      result.separation = distance;
      return;
    }
    m.add({radius * m.normal, pair.b_in_a.toA(q), distance, 1});
    return;
  }
  int k = 0;
  const Vec3 depth = h - c.cwiseAbs();
  depth.minCoeff(&k);
  const float sign = c[k] < 0.0f ? -1.0f : 1.0f;
  Vec3 on_face = q;
  on_face[k] = sign * h[k];
  m.normal = pair.b_in_a.rotation.col(k) * -sign;
  m.add({radius * m.normal, pair.b_in_a.toA(on_face), -depth[k] - radius, 1});
}

void collideSphereCylinder(const LocalPair& pair, LocalResult& result) {
  const float radius = std::get<Sphere>(pair.a).radius;
  const Cylinder& cylinder = std::get<Cylinder>(pair.b);
  const Vec3 c = pair.b_in_a.toB(Vec3::Zero());  // centre of the sphere, frame of the cylinder
  const float radial = std::sqrt(c.y() * c.y() + c.z() * c.z());
  const Vec3 outward = radial > 0.0f ? Vec3(0.0f, c.y() / radial, c.z() / radial) : Vec3::UnitY();
  const float x = std::clamp(c.x(), -cylinder.half_length, cylinder.half_length);
  const Vec3 nearest = Vec3(x, 0.0f, 0.0f) + std::min(radial, cylinder.radius) * outward;
  const float outside = (c - nearest).norm();

  Vec3 normal, on_surface;  // of the cylinder, outwards, in its frame
  float distance = 0.0f;
  if (outside > 1e-6f * (cylinder.half_length + cylinder.radius)) {
    normal = (c - nearest) / outside;
    on_surface = nearest;
    distance = outside - radius;
  } else if (cylinder.half_length - std::abs(c.x()) < cylinder.radius - radial) {
    const float sign = c.x() < 0.0f ? -1.0f : 1.0f;
    normal = sign * Vec3::UnitX();
    on_surface = Vec3(sign * cylinder.half_length, c.y(), c.z());
    distance = std::abs(c.x()) - cylinder.half_length - radius;
  } else {
    normal = outward;
    on_surface = Vec3(c.x(), 0.0f, 0.0f) + cylinder.radius * outward;
    distance = radial - cylinder.radius - radius;
  }
  LocalManifold& m = result.manifold;
  m.normal = pair.b_in_a.rotation * -normal;
  if (distance > pair.margin) {
    result.separation = distance;
    return;
  }
  m.add({radius * m.normal, pair.b_in_a.toA(on_surface), distance, 1});
}

}  // namespace pfx
