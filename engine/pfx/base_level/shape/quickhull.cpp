// Faces hold the points outside them; the farthest one replaces all faces that it can see by a cone over
// their horizon.
#include "pfx/base_level/shape/quickhull.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;

struct Face {
  HullTriangle t;
  std::vector<int> outside;  // points, the farthest one last
  double farthest = 0.0;
  bool alive = true;
};

struct HorizonEdge {
  int from, to;  // runs as in the face that goes away
  int neighbor;  // the face that stays
};

class Builder {
 public:
  Builder(std::span<const Vec3d> points, double tolerance) : points_(points), tolerance_(tolerance) {}

  bool startTetrahedron();
  void run();
  std::vector<HullTriangle> result() const;

 private:
  double height(const HullTriangle& t, int p) const { return t.normal.dot(points_[p]) - t.offset; }
  int addFace(int a, int b, int c);
  void assign(int point, std::span<const int> faces);
  void findVisible(int eye, int start);
  bool orderHorizon();
  void replaceVisible(int eye);

  std::span<const Vec3d> points_;
  double tolerance_;
  std::vector<Face> faces_;
  std::vector<int> pending_, visible_;
  std::vector<char> is_visible_;
  std::vector<HorizonEdge> horizon_;
};

int Builder::addFace(int a, int b, int c) {
  Face f;
  f.t.vertices = {a, b, c};
  f.t.neighbors = {-1, -1, -1};
  const Vec3d n = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
  const double length = n.norm();
  f.t.normal = length > 0.0 ? Vec3d(n / length) : Vec3d::Zero();
  f.t.offset = f.t.normal.dot(points_[a] + points_[b] + points_[c]) / 3.0;
  faces_.push_back(std::move(f));
  return int(faces_.size()) - 1;
}

void Builder::assign(int point, std::span<const int> faces) {
  int best = -1;
  double reach = tolerance_;
  for (int f : faces) {
    const double h = height(faces_[f].t, point);
    if (h > reach) reach = h, best = f;
  }
  if (best < 0) return;
  Face& f = faces_[best];
  if (f.outside.empty()) pending_.push_back(best);
  f.outside.push_back(point);
  if (reach > f.farthest) {
    f.farthest = reach;
  } else {
    std::swap(f.outside.back(), f.outside[f.outside.size() - 2]);
  }
}

bool Builder::startTetrahedron() {
  const int n = int(points_.size());
  int extreme[6] = {};
  for (int i = 1; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (points_[i][k] < points_[extreme[2 * k]][k]) extreme[2 * k] = i;
      if (points_[i][k] > points_[extreme[2 * k + 1]][k]) extreme[2 * k + 1] = i;
    }
  }
  int a = 0, b = 0, c = 0, d = 0;
  double best = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double s = (points_[extreme[2 * k]] - points_[extreme[2 * k + 1]]).squaredNorm();
    if (s > best) best = s, a = extreme[2 * k], b = extreme[2 * k + 1];
  }
  const Vec3d along = (points_[b] - points_[a]).normalized();
  best = tolerance_ * tolerance_;
  for (int i = 0; i < n; ++i) {
    const double s = along.cross(points_[i] - points_[a]).squaredNorm();
    if (s > best) best = s, c = i + 1;
  }
  if (c == 0) return false;
  c -= 1;
  const Vec3d normal = along.cross(points_[c] - points_[a]).normalized();
  best = tolerance_;
  for (int i = 0; i < n; ++i) {
    const double h = std::abs(normal.dot(points_[i] - points_[a]));
    if (h > best) best = h, d = i + 1;
  }
  if (d == 0) return false;
  d -= 1;
  if (normal.dot(points_[d] - points_[a]) > 0.0) std::swap(b, c);

  const int f[4] = {addFace(a, b, c), addFace(a, d, b), addFace(b, d, c), addFace(c, d, a)};
  faces_[f[0]].t.neighbors = {f[1], f[2], f[3]};
  faces_[f[1]].t.neighbors = {f[3], f[2], f[0]};
  faces_[f[2]].t.neighbors = {f[1], f[3], f[0]};
  faces_[f[3]].t.neighbors = {f[2], f[1], f[0]};
  for (int i = 0; i < n; ++i) {
    if (i != a && i != b && i != c && i != d) assign(i, f);
  }
  return true;
}

void Builder::findVisible(int eye, int start) {
  visible_.assign(1, start);
  horizon_.clear();
  is_visible_.resize(faces_.size(), 0);
  is_visible_[start] = 1;
  for (size_t i = 0; i < visible_.size(); ++i) {
    const HullTriangle& t = faces_[visible_[i]].t;
    for (int e = 0; e < 3; ++e) {
      const int g = t.neighbors[e];
      if (is_visible_[g] || !(height(faces_[g].t, eye) > tolerance_)) continue;
      is_visible_[g] = 1;
      visible_.push_back(g);
    }
  }
  for (int f : visible_) {
    const HullTriangle& t = faces_[f].t;
    for (int e = 0; e < 3; ++e) {
      if (!is_visible_[t.neighbors[e]])
        horizon_.push_back({t.vertices[e], t.vertices[(e + 1) % 3], t.neighbors[e]});
    }
  }
}

// Brings the horizon into the order of a loop. False when it is not one simple loop, which only rounding can
// cause.
bool Builder::orderHorizon() {
  for (size_t i = 0; i + 1 < horizon_.size(); ++i) {
    int found = 0;
    size_t next = 0;
    for (size_t j = 0; j < horizon_.size(); ++j) {
      if (horizon_[j].from == horizon_[i].to) ++found, next = j;
    }
    if (found != 1 || next <= i) return false;
    std::swap(horizon_[i + 1], horizon_[next]);
  }
  return horizon_.size() >= 3 && horizon_.back().to == horizon_.front().from;
}

void Builder::replaceVisible(int eye) {
  const int first = int(faces_.size()), count = int(horizon_.size());
  std::vector<int> fresh(count);
  for (int i = 0; i < count; ++i) {
    const HorizonEdge& edge = horizon_[i];
    fresh[i] = addFace(edge.from, edge.to, eye);
    faces_[fresh[i]].t.neighbors = {edge.neighbor, first + (i + 1) % count, first + (i + count - 1) % count};
    HullTriangle& outer = faces_[edge.neighbor].t;
    for (int e = 0; e < 3; ++e) {
      if (outer.vertices[e] == edge.to && outer.vertices[(e + 1) % 3] == edge.from)
        outer.neighbors[e] = fresh[i];
    }
  }
  for (int f : visible_) {
    faces_[f].alive = false;
    const std::vector<int> orphans = std::move(faces_[f].outside);
    faces_[f].outside.clear();
    for (int p : orphans) {
      if (p != eye) assign(p, fresh);
    }
  }
}

void Builder::run() {
  while (!pending_.empty()) {
    const int f = pending_.back();
    Face& face = faces_[f];
    if (!face.alive || face.outside.empty()) {
      pending_.pop_back();
      continue;
    }
    const int eye = face.outside.back();
    findVisible(eye, f);
    if (orderHorizon()) {
      replaceVisible(eye);
    } else {
      face.outside.pop_back();  // not seen cleanly: the point is left out
    }
    for (int g : visible_) is_visible_[g] = 0;
  }
}

std::vector<HullTriangle> Builder::result() const {
  std::vector<int> index(faces_.size(), -1);
  std::vector<HullTriangle> triangles;
  for (size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].alive) continue;
    index[f] = int(triangles.size());
    triangles.push_back(faces_[f].t);
  }
  for (HullTriangle& t : triangles) {
    for (int& n : t.neighbors) n = index[n];
  }
  return triangles;
}

}  // namespace

std::optional<std::vector<HullTriangle>> quickhull(std::span<const Vec3d> points, double tolerance) {
  Builder builder(points, tolerance);
  if (points.size() < 4 || !builder.startTetrahedron()) return std::nullopt;
  builder.run();
  return builder.result();
}

}  // namespace pfx
