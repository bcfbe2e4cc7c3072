// The descent ends at an axis whose own closest points are the deepest points of the overlap.
#include "pfx/base_level/collision/overlap_descent.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

constexpr int kMaxSteps = 16;
constexpr float kPull = 0.02f;  // of the smaller core: the gap at which the next axis is measured
constexpr float kDeep = 0.2f;   // of the smaller core: overlaps beyond this are searched from several sides
constexpr int kMaxStarts = 6;
constexpr int kGrid = 64;
constexpr float kSameDirection = 0.9f;
constexpr float kProgress = 1e-6f;  // of the smaller core: less than this ends the descent

// Size of a core for tolerances: half the extent along its thinnest direction, or the whole of a segment or
// point.
float thickness(const ConvexCore& core) {
  switch (core.kind) {
    case ConvexCore::Kind::Box:
      return core.size.minCoeff();
    case ConvexCore::Kind::Cylinder:
      return std::min(core.size.x(), core.size.y());
    case ConvexCore::Kind::Polytope:
      return core.polytope->inner_radius;
    case ConvexCore::Kind::Segment:
      return std::max(core.size.x(), core.radius);
    case ConvexCore::Kind::Point:
      break;
  }
  return core.radius;
}

struct Start {
  Vec3 normal;
  float separation;
};

// Keeps the best starts that point in clearly different directions, best first. Returns their number.
int insertStart(std::array<Start, kMaxStarts>& starts, int count, const Start& s) {
  for (int i = 0; i < count; ++i) {
    if (starts[i].normal.dot(s.normal) < kSameDirection) continue;
    if (starts[i].separation >= s.separation) return count;
    std::copy(starts.begin() + i + 1, starts.begin() + count, starts.begin() + i);
    --count;
    break;
  }
  int place = 0;
  while (place < count && starts[place].separation >= s.separation) ++place;
  if (place == kMaxStarts) return count;
  count = std::min(count + 1, kMaxStarts);
  std::copy_backward(starts.begin() + place, starts.begin() + count - 1, starts.begin() + count);
  starts[place] = s;
  return count;
}

// Direction i of kGrid spread evenly over the sphere (Fibonacci lattice).
Vec3 gridDirection(int i) {
  const float z = 1.0f - (2.0f * float(i) + 1.0f) / float(kGrid), r = std::sqrt(1.0f - z * z);
  const SinCos turn = sincos(2.39996323f * float(i));
  return Vec3(r * turn.cos, r * turn.sin, z);
}

// The deepest point of the smaller core, and its opposite on the other one; of a wide face any corner is as deep, and
// that may lie far from where the two meet.
CoreAxis startAt(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a, const Vec3& n) {
  CoreAxis axis{n, 0.0f, a.support(n).point, b_in_a.toA(b.support(-b_in_a.rotateToB(n)).point)};
  axis.separation = n.dot(axis.point_b - axis.point_a);
  if (a.outerRadius() < b.outerRadius())
    axis.point_b = axis.point_a + axis.separation * n;
  else
    axis.point_a = axis.point_b - axis.separation * n;
  return axis;
}

}  // namespace

float separationAlong(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a,
                      const Vec3& axis) {
  return startAt(a, b, b_in_a, axis).separation;
}

CoreAxis descendOverlap(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a,
                        const Vec3& start) {
  CoreAxis best = startAt(a, b, b_in_a, start);
  const float size = std::min(thickness(a), thickness(b));
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3 shift = (kPull * size - best.separation) * best.normal;
    const RelativePose pulled(b_in_a.rotation, b_in_a.position + shift);
    const GjkResult gjk = gjkDistance({a, b, pulled, best.normal});
    if (gjk.state != GjkResult::State::Separated) break;
    const float separation = separationAlong(a, b, b_in_a, gjk.normal);
    const float gain = separation - best.separation;
    if (gain < -kProgress * size) break;
    best = {gjk.normal, separation, gjk.point_a, gjk.point_b - shift};
    if (gain <= kProgress * size) break;
  }
  return best;
}

CoreAxis leastOverlap(const ConvexCore& a, const ConvexCore& b, const RelativePose& b_in_a,
                      std::span<const Vec3> candidates) {
  std::array<Start, kMaxStarts> starts;
  int count = 0;
  const auto consider = [&](const Vec3& n) {
    const Start s{n, separationAlong(a, b, b_in_a, n)};
    count = insertStart(starts, count, s);
  };
  for (const Vec3& n : candidates) consider(n);
  CoreAxis best = descendOverlap(a, b, b_in_a, starts[0].normal);
  if (-best.separation < kDeep * std::min(thickness(a), thickness(b))) return best;

  for (int i = 0; i < kGrid; ++i) consider(gridDirection(i));
  for (int i = 0; i < count; ++i) {
    const CoreAxis axis = descendOverlap(a, b, b_in_a, starts[i].normal);
    if (axis.separation > best.separation) best = axis;
  }
  return best;
}

}  // namespace pfx
