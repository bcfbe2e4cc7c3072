// The simplex holds points w = b - a of the difference B - A; the search looks for its point v closest to the
// origin. Sub-problems by Voronoi regions (C. Ericson, Real-Time Collision Detection, 2005, chapter 5.1).
#include "pfx/base_level/collision/gjk.h"

#include <cmath>

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;

constexpr int kMaxIterations = 64;

struct SimplexVertex {
  Vec3d w;
  Vec3 a, b;  // frame of A
  uint32_t id_a = 0, id_b = 0;
  double weight = 1.0;
};

struct Simplex {
  SimplexVertex v[4];
  int count = 0;

  Vec3d closest() const {
    Vec3d p = Vec3d::Zero();
    for (int i = 0; i < count; ++i) p += v[i].weight * v[i].w;
    return p;
  }
  void keep(std::initializer_list<std::pair<int, double>> kept) {
    SimplexVertex old[4] = {v[0], v[1], v[2], v[3]};
    count = 0;
    for (const auto& [index, weight] : kept) {
      v[count] = old[index];
      v[count++].weight = weight;
    }
  }
};

void solveSegment(Simplex& s) {
  const Vec3d ab = s.v[1].w - s.v[0].w;
  const double denominator = ab.squaredNorm();
  const double t = -s.v[0].w.dot(ab);
  if (t <= 0.0) return s.keep({{0, 1.0}});
  if (t >= denominator) return s.keep({{1, 1.0}});
  const double u = t / denominator;
  s.keep({{0, 1.0 - u}, {1, u}});
}

// Barycentric weights of the point closest to the origin; zero weights name the vertices that are dropped.
struct TriangleWeights {
  double w[3];
};

TriangleWeights solveTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return {{1, 0, 0}};
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return {{0, 1, 0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {{1 - t, t, 0}};
  }
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return {{0, 0, 1}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {{1 - t, 0, t}};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {{0, 1 - t, t}};
  }
  const double scale = 1.0 / (va + vb + vc);
  return {{va * scale, vb * scale, vc * scale}};
}

void keepTriangle(Simplex& s, const int (&index)[3], const TriangleWeights& weights) {
  SimplexVertex old[4] = {s.v[0], s.v[1], s.v[2], s.v[3]};
  s.count = 0;
  for (int i = 0; i < 3; ++i) {
    if (weights.w[i] <= 0.0) continue;
    s.v[s.count] = old[index[i]];
    s.v[s.count++].weight = weights.w[i];
  }
}

// Returns true when the origin lies inside.
bool solveTetrahedron(Simplex& s) {
  static constexpr int kFaces[4][4] = {
      {0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};  // last: opposite vertex
  double best = 0.0;
  int best_face = -1;
  TriangleWeights best_weights{};
  for (int f = 0; f < 4; ++f) {
    const Vec3d &a = s.v[kFaces[f][0]].w, &b = s.v[kFaces[f][1]].w, &c = s.v[kFaces[f][2]].w;
    const Vec3d n = (b - a).cross(c - a);
    const double origin_side = -a.dot(n), inner_side = (s.v[kFaces[f][3]].w - a).dot(n);
    if (origin_side * inner_side > 0.0) continue;  // a flat tetrahedron has inner_side 0: all its faces count
    const TriangleWeights weights = solveTriangle(a, b, c);
    const double squared = (weights.w[0] * a + weights.w[1] * b + weights.w[2] * c).squaredNorm();
    if (best_face < 0 || squared < best) best = squared, best_face = f, best_weights = weights;
  }
  if (best_face < 0) return true;
  keepTriangle(s, {kFaces[best_face][0], kFaces[best_face][1], kFaces[best_face][2]}, best_weights);
  return false;
}

bool solve(Simplex& s) {
  if (s.count == 2) solveSegment(s);
  if (s.count == 3) keepTriangle(s, {0, 1, 2}, solveTriangle(s.v[0].w, s.v[1].w, s.v[2].w));
  return s.count == 4 && solveTetrahedron(s);
}

SimplexVertex supportPair(const GjkInput& in, const Vec3& from_a_to_b) {
  const ConvexCore::Support a = in.a.support(from_a_to_b);
  const ConvexCore::Support b = in.b.support(in.b_in_a.rotateToB(Vec3(-from_a_to_b)));
  const Vec3 b_point = in.b_in_a.toA(b.point);
  return {b_point.cast<double>() - a.point.cast<double>(), a.point, b_point, a.id, b.id, 1.0};
}

bool contains(const Simplex& s, const SimplexVertex& p) {
  for (int i = 0; i < s.count; ++i) {
    const bool same_ids = s.v[i].id_a == p.id_a && s.v[i].id_b == p.id_b && p.id_a != ConvexCore::kSmooth &&
                          p.id_b != ConvexCore::kSmooth;
    if (same_ids || s.v[i].w == p.w) return true;
  }
  return false;
}

GjkResult separated(const Simplex& s, const Vec3d& v, int iterations) {
  GjkResult r;
  Vec3d a = Vec3d::Zero(), b = Vec3d::Zero();
  for (int i = 0; i < s.count; ++i) {
    a += s.v[i].weight * s.v[i].a.cast<double>();
    b += s.v[i].weight * s.v[i].b.cast<double>();
  }
  r.state = GjkResult::State::Separated;
  r.distance = float(v.norm());
  r.normal = v.normalized().cast<float>();
  r.point_a = a.cast<float>();
  r.point_b = b.cast<float>();
  r.iterations = iterations;
  return r;
}

}  // namespace

GjkResult gjkDistance(const GjkInput& in) {
  Vec3 direction = in.direction;
  if (direction.isZero(0.0f)) direction = in.b_in_a.toA(in.b.center()) - in.a.center();
  if (direction.isZero(0.0f)) direction = Vec3::UnitX();

  Simplex s;
  s.v[0] = supportPair(in, direction);
  s.count = 1;
  Vec3d v = s.v[0].w;
  {
    const double length = direction.cast<double>().norm();
    const double bound = v.dot(direction.cast<double>()) / length;
    if (bound > in.limit) {
      return {GjkResult::State::BeyondLimit,
              float(bound),
              (direction.cast<double>() / length).cast<float>(),
              {},
              {},
              1};
    }
  }
  double scale = v.cwiseAbs().maxCoeff();
  for (int iteration = 1; iteration < kMaxIterations; ++iteration) {
    const double length = v.norm();
    if (length <= 2e-7 * scale) return {};  // closer than float coordinates can tell
    const SimplexVertex p = supportPair(in, v.cast<float>());
    scale = std::max(scale, p.w.cwiseAbs().maxCoeff());
    const double bound = v.dot(p.w) / length;
    if (bound > in.limit) {
      return {GjkResult::State::BeyondLimit, float(bound), (v / length).cast<float>(), {}, {}, iteration};
    }
    // `bound` <= distance <= `length`. The last term is what the rounding of float support points can hide.
    if (length - bound <= 1e-7 * length + 1e-7 * scale || contains(s, p)) return separated(s, v, iteration);
    s.v[s.count++] = p;
    if (solve(s)) return {};
    const Vec3d next = s.closest();
    if (!(next.squaredNorm() < v.squaredNorm())) return separated(s, next, iteration);
    v = next;
  }
  return separated(s, v, kMaxIterations);
}

}  // namespace pfx
