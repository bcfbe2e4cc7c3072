// From hull triangles to a convex mesh: coplanar triangles are merged into polygons, vertices that only two
// faces share vanish, then edges, radii and exact volume integrals follow.
#include "pfx/base_level/shape/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "pfx/base_level/shape/quickhull.h"

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;

constexpr double kHullTolerance = 5e-7;   // of the size: rounding of float coordinates
constexpr double kMergeTolerance = 2e-6;  // of the size
constexpr double kConcaveTolerance = 1e-4;

using Loop = std::vector<int>;  // point indices, counter-clockwise

double sizeOf(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  return double((box.max - box.min).norm());
}

double doubleArea(const HullTriangle& t, std::span<const Vec3d> p) {
  return (p[t.vertices[1]] - p[t.vertices[0]]).cross(p[t.vertices[2]] - p[t.vertices[0]]).norm();
}

// Gives every triangle the index of its face: flood fill from the largest triangle over neighbours in its
// plane.
std::vector<int> mergeCoplanar(const std::vector<HullTriangle>& triangles, std::span<const Vec3d> points,
                               double tolerance) {
  std::vector<int> order(triangles.size()), group(triangles.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return doubleArea(triangles[a], points) > doubleArea(triangles[b], points);
  });
  int count = 0;
  std::vector<int> stack;
  for (int seed : order) {
    if (group[seed] >= 0) continue;
    const HullTriangle& plane = triangles[seed];
    group[seed] = count;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      for (int n : triangles[t].neighbors) {
        if (group[n] >= 0) continue;
        const auto& v = triangles[n].vertices;
        const bool flat = std::all_of(v.begin(), v.end(), [&](int i) {
          return std::abs(plane.normal.dot(points[i]) - plane.offset) <= tolerance;
        });
        if (!flat || plane.normal.dot(triangles[n].normal) < 0.0) continue;
        group[n] = count;
        stack.push_back(n);
      }
    }
    ++count;
  }
  return group;
}

// Boundary of each group as a loop of points. Empty when some boundary is not one simple loop.
std::vector<Loop> boundaries(const std::vector<HullTriangle>& triangles, const std::vector<int>& group) {
  const int count = 1 + *std::max_element(group.begin(), group.end());
  std::vector<std::map<int, int>> next(count);
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int e = 0; e < 3; ++e) {
      if (group[triangles[t].neighbors[e]] == group[t]) continue;
      const bool fresh =
          next[group[t]].emplace(triangles[t].vertices[e], triangles[t].vertices[(e + 1) % 3]).second;
      if (!fresh) return {};
    }
  }
  std::vector<Loop> loops(count);
  for (int g = 0; g < count; ++g) {
    if (next[g].empty()) return {};
    const int start = next[g].begin()->first;
    int v = start;
    do {
      loops[g].push_back(v);
      const auto it = next[g].find(v);
      if (it == next[g].end()) return {};
      v = it->second;
    } while (v != start && loops[g].size() <= next[g].size());
    if (loops[g].size() != next[g].size()) return {};
  }
  return loops;
}

// Drops vertices that only two faces share: they lie on a straight edge.
void dropStraightVertices(std::vector<Loop>& loops) {
  std::map<int, int> faces_at;
  for (const Loop& loop : loops) {
    for (int v : loop) ++faces_at[v];
  }
  for (Loop& loop : loops) std::erase_if(loop, [&](int v) { return faces_at[v] < 3; });
  std::erase_if(loops, [](const Loop& loop) { return loop.size() < 3; });
}

std::vector<Loop> triangleLoops(const std::vector<HullTriangle>& triangles) {
  std::vector<Loop> loops;
  for (const HullTriangle& t : triangles) loops.emplace_back(t.vertices.begin(), t.vertices.end());
  return loops;
}

// Plane through a polygon (normal by Newell's method) that leaves no vertex of it outside.
Plane planeOf(const Loop& loop, std::span<const Vec3d> points) {
  Vec3d normal = Vec3d::Zero();
  const Vec3d& origin = points[loop[0]];
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    normal += (points[loop[i]] - origin).cross(points[loop[i + 1]] - origin);
  }
  normal.normalize();
  double offset = normal.dot(origin);
  for (int v : loop) offset = std::max(offset, normal.dot(points[v]));
  return {normal.cast<float>(), float(offset)};
}

bool buildEdges(ConvexMesh& mesh) {
  std::map<std::pair<int, int>, uint16_t> half;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const PolytopeFace& face = mesh.faces[f];
    for (uint32_t i = 0; i < face.count; ++i) {
      const int v = mesh.face_vertices[face.first + i],
                w = mesh.face_vertices[face.first + (i + 1) % face.count];
      if (!half.emplace(std::pair(v, w), uint16_t(f)).second) return false;
    }
  }
  for (const auto& [edge, left] : half) {
    const auto twin = half.find({edge.second, edge.first});
    if (twin == half.end()) return false;
    if (edge.first < edge.second) {
      mesh.edges.push_back({uint16_t(edge.first), uint16_t(edge.second), left, twin->second});
    }
  }
  return mesh.vertices.size() + mesh.faces.size() == mesh.edges.size() + 2;
}

// Exact integrals over the tetrahedra between an inner point and the triangles of the faces. Source: F.
// Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor, J. Math. Stat. 1(1), 2005
// (covariance form).
void integrateVolume(ConvexMesh& mesh) {
  Vec3d origin = Vec3d::Zero();
  for (const Vec3& v : mesh.vertices) origin += v.cast<double>();
  origin /= double(mesh.vertices.size());
  double volume = 0.0;
  Vec3d moment = Vec3d::Zero();
  Mat3d covariance = Mat3d::Zero();
  for (const PolytopeFace& face : mesh.faces) {
    const auto vertex = [&](uint32_t i) -> Vec3d {
      return mesh.vertices[mesh.face_vertices[face.first + i]].cast<double>() - origin;
    };
    for (uint32_t i = 1; i + 1 < face.count; ++i) {
      const Vec3d a = vertex(0), b = vertex(i), c = vertex(i + 1), sum = a + b + c;
      const double six_volume = a.dot(b.cross(c));
      volume += six_volume / 6.0;
      moment += six_volume / 24.0 * sum;
      covariance += six_volume / 120.0 *
                    (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  }
  const Vec3d center = moment / volume;
  covariance -= volume * center * center.transpose();
  mesh.volume = float(volume);
  mesh.centroid = (origin + center).cast<float>();
  mesh.unit_inertia = (covariance.trace() * Mat3d::Identity() - covariance).cast<float>();
}

void measure(ConvexMesh& mesh) {
  integrateVolume(mesh);
  mesh.bounds = Aabb{};
  mesh.outer_radius = 0.0f;
  for (const Vec3& v : mesh.vertices) {
    mesh.bounds.extend(v);
    mesh.outer_radius = std::max(mesh.outer_radius, v.norm());
  }
  mesh.inner_radius = mesh.outer_radius + mesh.centroid.norm();
  for (const Plane& p : mesh.planes)
    mesh.inner_radius = std::min(mesh.inner_radius, p.offset - p.normal.dot(mesh.centroid));
}

Error assemble(const std::vector<Loop>& loops, std::span<const Vec3d> points, ConvexMesh& mesh) {
  mesh = {};
  std::vector<int> index(points.size(), -1);
  for (const Loop& loop : loops) {
    for (int v : loop) index[v] = 0;
  }
  int count = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (index[i] < 0) continue;
    index[i] = count++;
    mesh.vertices.push_back(points[i].cast<float>());
  }
  if (count > 0xffff || loops.size() > 0xffff) return Error::OutOfRange;
  for (const Loop& loop : loops) {
    if (loop.size() > kMaxFaceVertices) return Error::OutOfRange;
    mesh.faces.push_back({uint32_t(mesh.face_vertices.size()), uint32_t(loop.size())});
    for (int v : loop) mesh.face_vertices.push_back(uint16_t(index[v]));
    mesh.planes.push_back(planeOf(loop, points));
  }
  if (!buildEdges(mesh)) return Error::Degenerate;
  measure(mesh);
  std::vector<Vec3> normals;
  for (const Plane& p : mesh.planes) normals.push_back(p.normal);
  mesh.packed_vertices = packFours(mesh.vertices);
  mesh.packed_normals = packFours(normals);
  const bool solid = std::isfinite(mesh.volume) && mesh.volume > 0.0f && mesh.inner_radius > 0.0f;
  return solid ? Error::Ok : Error::Degenerate;
}

Error buildHull(std::span<const Vec3> points, ConvexMesh& mesh) {
  for (const Vec3& p : points) {
    if (!p.allFinite()) return Error::InvalidValue;
  }
  const double size = sizeOf(points);
  if (points.size() < 4 || !(size > 0.0)) return Error::Degenerate;
  if (!std::isfinite(size)) return Error::InvalidValue;

  std::vector<Vec3d> exact;
  exact.reserve(points.size());
  for (const Vec3& p : points) exact.push_back(p.cast<double>());
  const auto triangles = quickhull(exact, kHullTolerance * size);
  if (!triangles) return Error::Degenerate;

  std::vector<Loop> loops = boundaries(*triangles, mergeCoplanar(*triangles, exact, kMergeTolerance * size));
  if (!loops.empty()) {
    dropStraightVertices(loops);
    const Error error = assemble(loops, exact, mesh);
    if (error != Error::Degenerate) return error;
  }
  return assemble(triangleLoops(*triangles), exact,
                  mesh);  // merging failed; plain triangles are always right
}

double area(const ConvexMesh& mesh) {
  double sum = 0.0;
  for (const PolytopeFace& face : mesh.faces) {
    const auto vertex = [&](uint32_t i) -> Vec3d {
      return mesh.vertices[mesh.face_vertices[face.first + i]].cast<double>();
    };
    for (uint32_t i = 1; i + 1 < face.count; ++i) {
      sum += 0.5 * (vertex(i) - vertex(0)).cross(vertex(i + 1) - vertex(0)).norm();
    }
  }
  return sum;
}

}  // namespace

Error buildConvexMesh(std::span<const Vec3> points, ConvexMesh& mesh) {
  const Error error = buildHull(points, mesh);
  if (error != Error::Ok) mesh = {};
  return error;
}

Error checkConvexMesh(std::span<const Vec3> vertices, std::span<const uint32_t> triangles, ConvexMesh& mesh) {
  mesh = {};
  if (triangles.size() % 3 != 0) return Error::OutOfRange;
  for (uint32_t i : triangles) {
    if (i >= vertices.size()) return Error::OutOfRange;
  }
  std::vector<Vec3> used;  // vertices that no triangle uses do not count
  for (uint32_t i : triangles) used.push_back(vertices[i]);
  if (const Error error = buildConvexMesh(used, mesh); error != Error::Ok) return error;

  // A triangle belongs to the surface when one face's plane holds all its corners.
  const float tolerance = float(kConcaveTolerance * sizeOf(used));
  double covered = 0.0;
  for (size_t i = 0; i < used.size(); i += 3) {
    const Vec3 &a = used[i], &b = used[i + 1], &c = used[i + 2];
    const bool on_surface = std::any_of(mesh.planes.begin(), mesh.planes.end(), [&](const Plane& p) {
      return p.offset - std::min({p.normal.dot(a), p.normal.dot(b), p.normal.dot(c)}) <= tolerance;
    });
    if (!on_surface) {
      mesh = {};
      return Error::NotConvex;
    }
    covered += 0.5 * (b - a).cross(c - a).cast<double>().norm();
  }
  const double expected = area(mesh);
  if (std::abs(covered - expected) > 1e-3 * expected) {
    mesh = {};
    return Error::NotConvex;
  }
  return Error::Ok;
}

}  // namespace pfx
