// Up to eight candidates are searched exhaustively; more are first thinned to the extreme points in eight
// directions, which loses at most a few per cent of the area.
#include "pfx/base_level/collision/contact_reduction.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

constexpr int kMaxExhaustive = 8;

struct Planar {
  float x, y, distance;
  int index;
};

float cross(const Planar& o, const Planar& a, const Planar& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// Area of the hull of four points that need not be in convex position, times two.
float hullArea(const Planar& a, const Planar& b, const Planar& c, const Planar& d) {
  const float abc = std::abs(cross(a, b, c)), abd = std::abs(cross(a, b, d));
  const float acd = std::abs(cross(a, c, d)), bcd = std::abs(cross(b, c, d));
  return std::max(0.5f * (abc + abd + acd + bcd), std::max(std::max(abc, abd), std::max(acd, bcd)));
}

float squaredSpan(const Planar& a, const Planar& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// A few candidates in their own order, each at most once.
struct Thinned {
  Planar points[kMaxExhaustive];
  int count = 0;

  bool holds(int index) const {
    return std::any_of(points, points + count, [&](const Planar& p) { return p.index == index; });
  }
  void add(const Planar& p) {
    if (holds(p.index) || count == kMaxExhaustive) return;
    int place = count++;
    for (; place > 0 && points[place - 1].index > p.index; --place) points[place] = points[place - 1];
    points[place] = p;
  }
  float squaredDistance(const Planar& p) const {
    float nearest = 1e30f;
    for (int i = 0; i < count; ++i) nearest = std::min(nearest, squaredSpan(points[i], p));
    return nearest;
  }
};

// The deepest point and the extreme points in eight directions. A cloud with fewer than four of them gets
// those that lie farthest from what it has.
Thinned thinOut(std::span<const LocalContact> candidates, const TangentPair& t, int deepest) {
  static constexpr float kDirections[8][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                              {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const auto planar = [&](int i) {
    const LocalContact& c = candidates[i];
    return Planar{c.point_b.dot(t.t1), c.point_b.dot(t.t2), c.distance, i};
  };
  Thinned thinned;
  thinned.add(planar(deepest));
  for (const auto& d : kDirections) {
    Planar best = planar(0);
    for (int i = 1; i < int(candidates.size()); ++i) {
      const Planar p = planar(i);
      if (p.x * d[0] + p.y * d[1] > best.x * d[0] + best.y * d[1]) best = p;
    }
    thinned.add(best);
  }
  while (thinned.count < kMaxContactPoints) {
    Planar best = planar(0);
    float reach = -1.0f;
    for (int i = 0; i < int(candidates.size()); ++i) {
      const Planar p = planar(i);
      if (const float d = thinned.squaredDistance(p); d > reach && !thinned.holds(i)) reach = d, best = p;
    }
    thinned.add(best);
  }
  return thinned;
}

struct Choice {
  int i[4] = {0, 0, 0, 0};
  float area = -1.0f;
};

// `forced` is the index of a point that must be in the choice, or -1.
Choice largestQuad(const Planar* p, int n, int forced) {
  Choice best;
  for (int a = 0; a < n - 3; ++a)
    for (int b = a + 1; b < n - 2; ++b)
      for (int c = b + 1; c < n - 1; ++c)
        for (int d = c + 1; d < n; ++d) {
          if (forced >= 0 && forced != a && forced != b && forced != c && forced != d) continue;
          const float area = hullArea(p[a], p[b], p[c], p[d]);
          if (area > 1.02f * best.area) best = {{a, b, c, d}, area};
        }
  return best;
}

}  // namespace

void reduceContacts(std::span<const LocalContact> candidates, LocalManifold& manifold) {
  const int n = int(candidates.size());
  manifold.num_points = 0;
  if (n <= kMaxContactPoints) {
    for (const LocalContact& c : candidates) manifold.add(c);
    return;
  }

  int deepest = 0;
  for (int i = 1; i < n; ++i) {
    if (candidates[i].distance < candidates[deepest].distance) deepest = i;
  }
  const TangentPair t = tangents(manifold.normal);
  Thinned thinned;
  if (n <= kMaxExhaustive) {
    for (int i = 0; i < n; ++i) {
      thinned.add(
          {candidates[i].point_b.dot(t.t1), candidates[i].point_b.dot(t.t2), candidates[i].distance, i});
    }
  } else {
    thinned = thinOut(candidates, t, deepest);
  }
  const Planar* planar = thinned.points;
  const int count = thinned.count;
  if (count <= kMaxContactPoints) {
    for (int i = 0; i < count; ++i) manifold.add(candidates[planar[i].index]);
    return;
  }

  float span = 0.0f, max_distance = planar[0].distance;
  int forced = 0;
  for (int i = 0; i < count; ++i) {
    span = std::max(span, squaredSpan(planar[0], planar[i]));
    max_distance = std::max(max_distance, planar[i].distance);
    if (planar[i].index == deepest) forced = i;
  }
  const bool level = max_distance - candidates[deepest].distance <= 1e-4f * std::sqrt(span);
  const Choice choice = largestQuad(planar, count, level ? -1 : forced);
  for (int i : choice.i) manifold.add(candidates[planar[i].index]);
}

}  // namespace pfx
