#include "pfx/low_level/collision/merge_manifolds.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/collision/contact_reduction.h"

namespace pfx {
namespace {

constexpr float kSameNormal = 0.99999f;

// Points of all manifolds from `first` on with its normal; a candidate is named by manifold and point.
void gather(const RelativePose& b_in_a, std::span<const ContactManifold> manifolds, size_t first,
            Vector<LocalContact>& candidates) {
  candidates.clear();
  for (size_t k = first; k < manifolds.size(); ++k) {
    const ContactManifold& m = manifolds[k];
    if (m.local_normal.dot(manifolds[first].local_normal) < kSameNormal) continue;
    for (int i = 0; i < m.num_points; ++i) {
      const uint32_t name = static_cast<uint32_t>(k) << 2 | static_cast<uint32_t>(i);
      candidates.push_back(
          {m.points[i].local_a, b_in_a.toA(m.points[i].local_b), m.points[i].distance, name});
    }
  }
}

// Where a point lies around the origin: 0 .. 4, growing with its angle from -pi to pi.
float quarters(float x, float y) {
  const float size = std::abs(x) + std::abs(y);
  if (size == 0.0f) return 0.0f;
  return y < 0.0f ? 1.0f + x / size : 3.0f - x / size;
}

// Puts the points in the order in which they lie around the normal (in the frame of B), as those of a single face come.
// The solver takes them one after the other, and an impact is not the same in each order.
void goAround(const Vec3& normal_in_b, ContactManifold& m) {
  const TangentPair t = tangents(normal_in_b);
  Vec3 center = Vec3::Zero();
  for (int i = 0; i < m.num_points; ++i) center += m.points[i].local_b / static_cast<float>(m.num_points);
  const auto place = [&](const ContactPoint& p) {
    const Vec3 r = p.local_b - center;
    return quarters(r.dot(t.t1), -r.dot(t.t2));
  };
  for (int i = 1; i < m.num_points; ++i)
    for (int k = i; k > 0 && place(m.points[k]) < place(m.points[k - 1]); --k)
      std::swap(m.points[k], m.points[k - 1]);
}

}  // namespace

void mergeManifolds(const Transform& b_in_a, Vector<LocalContact>& candidates,
                    Vector<ContactManifold>& manifolds) {
  const RelativePose to_a(b_in_a);
  for (size_t first = 0; first < manifolds.size(); ++first) {
    gather(to_a, manifolds, first, candidates);
    if (candidates.size() == static_cast<size_t>(manifolds[first].num_points)) continue;
    LocalManifold best;
    best.normal = manifolds[first].local_normal;
    reduceContacts(candidates, best);
    ContactManifold merged = manifolds[first];
    merged.num_points = best.num_points;
    for (int i = 0; i < best.num_points; ++i)
      merged.points[i] = manifolds[best.points[i].feature >> 2].points[best.points[i].feature & 3];
    goAround(b_in_a.orientation.conjugate() * merged.local_normal, merged);
    const auto isJoined = [&](const ContactManifold& m) {
      return m.local_normal.dot(best.normal) >= kSameNormal;
    };
    manifolds.erase(
        std::remove_if(manifolds.begin() + static_cast<long>(first) + 1, manifolds.end(), isJoined),
        manifolds.end());
    manifolds[first] = merged;
  }
}

}  // namespace pfx
