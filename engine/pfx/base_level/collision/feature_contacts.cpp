// Everything is seen along the contact normal. In the plane of a disc the disc is an exact circle, so what
// the other shape shows is projected into that plane.
#include "pfx/base_level/collision/feature_contacts.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

constexpr float kLevel = 3e-4f;  // tilt (tangent) below which a cap counts as lying flat
constexpr float kParallelSquaredSine = 0.0027f;
constexpr float kInside = 1e-4f;  // of the radius; see kInsideTolerance in contact_clipping.cpp

// Distance along n from p to the plane through `origin` with the given normal.
float alongTo(const Vec3& p, const Vec3& origin, const Vec3& plane_normal, const Vec3& n) {
  return plane_normal.dot(origin - p) / plane_normal.dot(n);
}

Vec2 planar(const ContactDisc& disc, const Vec3& p, const Vec3& n) {
  const Vec3 q = p + alongTo(p, disc.center, disc.normal, n) * n - disc.center;
  return Vec2(q.dot(disc.u), q.dot(disc.v));
}

Vec3 lift(const ContactDisc& disc, const Vec2& p) { return disc.center + p.x() * disc.u + p.y() * disc.v; }

// Four directions in the disc's plane a quarter turn apart. A tilted disc has its lowest point among them.
Vec2 firstRimDirection(const ContactDisc& disc, const Vec3& other_normal, const Vec3& n) {
  const float slope = other_normal.dot(n);
  const Vec2 down(other_normal.dot(disc.u) / slope, other_normal.dot(disc.v) / slope);
  const Vec2 own(disc.normal.dot(disc.u), disc.normal.dot(disc.v));
  const Vec2 tilt = down - own;
  const float length = tilt.norm();
  return length > kLevel ? Vec2(tilt / length) : Vec2::UnitX();
}

Vec2 quarterTurns(const Vec2& d, int k) {
  switch (k & 3) {
    case 0:
      return d;
    case 1:
      return Vec2(-d.y(), d.x());
    case 2:
      return -d;
    default:
      return Vec2(d.y(), -d.x());
  }
}

struct Span {
  float lo, hi;
};

// Where the line p + t (q - p) runs inside the circle of radius r around the origin; lo > hi when it misses.
Span lineInCircle(const Vec2& p, const Vec2& q, float r) {
  const Vec2 d = q - p;
  const float a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - r * r;
  if (!(a > 0.0f)) return c <= 0.0f ? Span{0.0f, 1.0f} : Span{1.0f, 0.0f};
  const float root = b * b - a * c;
  if (root < 0.0f) return {1.0f, 0.0f};
  const float s = std::sqrt(root);
  return {(-b - s) / a, (-b + s) / a};
}

bool insideFace(const ContactPolygon& face, const Vec3& p, const Vec3& n, float tolerance) {
  const float orientation = face.normal.dot(n) >= 0.0f ? 1.0f : -1.0f;
  for (int i = 0; i < face.count; ++i) {
    const Vec3& r = face.vertices[i];
    const Vec3 side = (face.vertices[i + 1 < face.count ? i + 1 : 0] - r).cross(orientation * n);
    if (side.dot(p - r) > tolerance * side.norm()) return false;
  }
  return true;
}

}  // namespace

void ContactCollector::add(const Vec3& on_a, const Vec3& on_b, uint32_t feature) {
  const LocalContact c = oppositePoints(on_a, on_b, normal_, feature);
  if (c.distance > range_.margin || c.distance < range_.separation - range_.tolerance || count_ == kCapacity)
    return;
  contacts_[count_++] = c;
}

void ContactCollector::ensureDepth(const Vec3& on_a, const Vec3& on_b) {
  for (const LocalContact& c : contacts()) {
    if (c.distance <= range_.separation + range_.tolerance) return;
  }
  const LocalContact c = oppositePoints(on_a, on_b, normal_, 1);
  add(c.point_a, c.point_a + range_.separation * normal_, 1);
}

void ContactCollector::discFace(const ContactDisc& a, const ContactPolygon& b) {
  const auto addAt = [&](const Vec2& p, uint32_t id) {
    const Vec3 on_a = lift(a, p);
    add(on_a, on_a + alongTo(on_a, b.vertices[0], b.normal, normal_) * normal_,
        id | a.id << 12 | (b.id & 0xfff) << 16);
  };
  const Vec2 first = firstRimDirection(a, b.normal, normal_);
  for (int k = 0; k < 4; ++k) {
    const Vec2 rim = a.radius * quarterTurns(first, k);
    if (insideFace(b, lift(a, rim), normal_, kInside * a.radius)) addAt(rim, 2 + k);
  }
  for (int i = 0; i < b.count; ++i) {
    const Vec2 p = planar(a, b.vertices[i], normal_),
               q = planar(a, b.vertices[i + 1 < b.count ? i + 1 : 0], normal_);
    const Span span = lineInCircle(p, q, a.radius);
    if (!(span.lo < span.hi)) continue;
    if (span.lo <= 0.0f && span.hi > 0.0f) addAt(p, 16 + 4 * i);
    if (span.lo > 0.0f && span.lo < 1.0f) addAt(p + span.lo * (q - p), 17 + 4 * i);
    if (span.hi > 0.0f && span.hi < 1.0f) addAt(p + span.hi * (q - p), 18 + 4 * i);
  }
}

void ContactCollector::discDisc(const ContactDisc& a, const ContactDisc& b) {
  const uint32_t name = a.id << 12 | b.id << 16;
  const auto addOnA = [&](const Vec2& p, uint32_t id) {
    const Vec3 on_a = lift(a, p);
    add(on_a, on_a + alongTo(on_a, b.center, b.normal, normal_) * normal_, id | name);
  };
  const Vec2 first_a = firstRimDirection(a, b.normal, normal_),
             first_b = firstRimDirection(b, a.normal, normal_);
  for (int k = 0; k < 4; ++k) {
    const Vec2 rim_a = a.radius * quarterTurns(first_a, k), rim_b = b.radius * quarterTurns(first_b, k);
    if (planar(b, lift(a, rim_a), normal_).norm() <= b.radius * (1.0f + kInside)) addOnA(rim_a, 2 + k);
    const Vec3 on_b = lift(b, rim_b);
    if (planar(a, on_b, normal_).norm() > a.radius * (1.0f - kInside)) continue;
    add(on_b + alongTo(on_b, a.center, a.normal, normal_) * normal_, on_b, (6 + k) | name);
  }
  // Where the rims cross. B's rim is taken as a circle in the plane of A: the caps are nearly parallel when
  // both touch.
  const Vec2 c = planar(a, b.center, normal_);
  const float d = c.norm();
  if (!(d > kInside * a.radius) || d > a.radius + b.radius || d < std::abs(a.radius - b.radius)) return;
  const float x = (d * d + a.radius * a.radius - b.radius * b.radius) / (2.0f * d);
  const float y = std::sqrt(std::max(0.0f, a.radius * a.radius - x * x));
  const Vec2 toward = c / d;
  addOnA(x * toward + y * quarterTurns(toward, 1), 10);
  addOnA(x * toward - y * quarterTurns(toward, 1), 11);
  // The lens between them reaches farthest from the crossing line on the line of the centres.
  addOnA(a.radius * toward, 12);
  addOnA(c - b.radius * toward, 13);
}

void ContactCollector::discSegment(const ContactDisc& disc, const ContactSegment& segment, bool disc_is_a) {
  const Vec2 p = planar(disc, segment.p0, normal_), q = planar(disc, segment.p1, normal_);
  Span span = lineInCircle(p, q, disc.radius);
  span = {std::max(span.lo, 0.0f), std::min(span.hi, 1.0f)};
  if (!(span.lo < span.hi)) return;
  for (const auto& [t, id] : {std::pair(span.lo, 2u), std::pair(span.hi, 3u)}) {
    const Vec3 on_segment = segment.p0 + t * (segment.p1 - segment.p0);
    const Vec3 on_disc = on_segment + alongTo(on_segment, disc.center, disc.normal, normal_) * normal_;
    const uint32_t name = id | disc.id << 12 | segment.id << 16;
    disc_is_a ? add(on_disc, on_segment, name) : add(on_segment, on_disc, name);
  }
}

void ContactCollector::segmentFace(const ContactSegment& a, const ContactPolygon& b) {
  Span span{0.0f, 1.0f};
  const float orientation = b.normal.dot(normal_) >= 0.0f ? 1.0f : -1.0f;
  for (int i = 0; i < b.count; ++i) {
    const Vec3& r = b.vertices[i];
    const Vec3 outward = (b.vertices[i + 1 < b.count ? i + 1 : 0] - r).cross(orientation * normal_);
    const float d0 = outward.dot(a.p0 - r), d1 = outward.dot(a.p1 - r);
    if (d0 > 0.0f && d1 > 0.0f) return;
    if (d0 > 0.0f) span.lo = std::max(span.lo, d0 / (d0 - d1));
    if (d1 > 0.0f) span.hi = std::min(span.hi, d0 / (d0 - d1));
  }
  if (!(span.lo < span.hi)) return;
  for (const auto& [t, id] : {std::pair(span.lo, 2u), std::pair(span.hi, 3u)}) {
    const Vec3 on_a = a.p0 + t * (a.p1 - a.p0);
    const Vec3 on_b = on_a + alongTo(on_a, b.vertices[0], b.normal, normal_) * normal_;
    add(on_a, on_b, id | a.id << 12 | (b.id & 0xfff) << 16);
  }
}

void ContactCollector::segmentSegment(const ContactSegment& a, const ContactSegment& b) {
  const Vec3 da = a.p1 - a.p0, db = b.p1 - b.p0;
  const float aa = da.squaredNorm(), bb = db.squaredNorm();
  if (!(aa > 0.0f) || !(bb > 0.0f) || da.cross(db).squaredNorm() > kParallelSquaredSine * aa * bb) return;
  const float s0 = da.dot(b.p0 - a.p0) / aa, s1 = da.dot(b.p1 - a.p0) / aa;
  const float lo = std::max(0.0f, std::min(s0, s1)), hi = std::min(1.0f, std::max(s0, s1));
  if (!(hi - lo > 1e-3f)) return;
  for (const auto& [s, id] : {std::pair(lo, 2u), std::pair(hi, 3u)}) {
    add(a.p0 + s * da, b.p0 + (s - s0) / (s1 - s0) * db, id | a.id << 12 | b.id << 16);
  }
}

}  // namespace pfx
