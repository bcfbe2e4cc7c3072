// Contact patches of the features that a cylinder or capsule brings: discs and segments, against each other
// and faces.
#pragma once

#include "pfx/base_level/collision/contact_clipping.h"

namespace pfx {

// All in the frame of A. A cap of a cylinder.
struct ContactDisc {
  Vec3 center;
  Vec3 normal;   // unit, outwards
  Vec3 u, v;     // unit, in the plane of the disc, fixed in the body
  float radius;  // m
  uint32_t id;
};

// The line of a cylinder's side, or of a capsule's surface, that faces the other shape.
struct ContactSegment {
  Vec3 p0, p1;
  uint32_t id;
};

// Collects contacts along `normal` (unit, from A to B). Points farther apart than `margin` are left out, and
// so are points deeper than `separation`, the gap of the shapes along the normal: such a point would lie
// beside one of them.
class ContactCollector {
 public:
  struct Range {
    float separation, margin, tolerance;  // m
  };
  ContactCollector(const Vec3& normal, const Range& range) : normal_(normal), range_(range) {}

  void discFace(const ContactDisc& a, const ContactPolygon& b);
  void discDisc(const ContactDisc& a, const ContactDisc& b);
  void discSegment(const ContactDisc& disc, const ContactSegment& segment, bool disc_is_a);
  void segmentFace(const ContactSegment& a, const ContactPolygon& b);
  void segmentSegment(const ContactSegment& a, const ContactSegment& b);

  void add(const Vec3& on_a, const Vec3& on_b, uint32_t feature);

  // Adds a deepest point that is known from elsewhere, unless a collected one is as deep. What its two ends
  // are apart across the normal is shared between them.
  void ensureDepth(const Vec3& on_a, const Vec3& on_b);

  std::span<const LocalContact> contacts() const { return {contacts_, size_t(count_)}; }

 private:
  static constexpr int kCapacity = 2 * kMaxFaceVertices + 16;

  Vec3 normal_;
  Range range_;
  int count_ = 0;
  LocalContact contacts_[kCapacity];
};

}  // namespace pfx
