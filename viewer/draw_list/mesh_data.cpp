#include "viewer/draw_list/mesh_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace viewer {

namespace {

using pfx::Vec3;

struct Triangle {
  std::array<uint32_t, 3> corner;  // welded points
  Vec3 normal;                     // unit
  std::array<bool, 3> feature{};   // edge k lies opposite corner k
};

// Gives points at the same place the same number, so that meshes made of separate facets know their
// neighbours.
std::vector<uint32_t> weld(std::span<const Vec3> points) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::map<Vec3, uint32_t, decltype(less)> first(less);
  std::vector<uint32_t> welded;
  welded.reserve(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) welded.push_back(first.emplace(points[i], i).first->second);
  return welded;
}

std::vector<Triangle> collectTriangles(std::span<const Vec3> points, std::span<const uint32_t> indices) {
  const std::vector<uint32_t> welded = weld(points);
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    if (std::max({indices[i], indices[i + 1], indices[i + 2]}) >= points.size()) continue;
    const std::array<uint32_t, 3> c = {welded[indices[i]], welded[indices[i + 1]], welded[indices[i + 2]]};
    const Vec3 n = (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]);
    const float length = n.norm();
    if (!(length > 0.0f) || !std::isfinite(length)) continue;
    triangles.push_back({c, n / length, {}});
  }
  return triangles;
}

// Marks edges that are open or whose faces differ by more than the feature angle.
void markFeatureEdges(std::vector<Triangle>& triangles) {
  struct Side {
    uint64_t edge;
    uint32_t triangle, opposite;
  };
  std::vector<Side> sides;
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (uint32_t k = 0; k < 3; ++k) {
      const auto [lo, hi] = std::minmax(triangles[t].corner[(k + 1) % 3], triangles[t].corner[(k + 2) % 3]);
      sides.push_back({uint64_t(lo) << 32 | hi, t, k});
    }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  for (size_t i = 0; i < sides.size();) {
    size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
    const bool smooth = end - i == 2 && triangles[sides[i].triangle].normal.dot(
                                            triangles[sides[i + 1].triangle].normal) > kCosFeatureAngle;
    for (; i < end; ++i) triangles[sides[i].triangle].feature[sides[i].opposite] = !smooth;
  }
}

// Angle of a triangle at one of its corners, rad.
float angleAt(const Triangle& t, uint32_t corner, std::span<const Vec3> points) {
  const auto k = size_t(std::find(t.corner.begin(), t.corner.end(), corner) - t.corner.begin());
  const Vec3 a = points[t.corner[(k + 1) % 3]] - points[corner],
             b = points[t.corner[(k + 2) % 3]] - points[corner];
  return float(std::atan2(double(a.cross(b).norm()), double(a.dot(b))));
}

// Mean of the normals round a point, of those triangles that are smooth with this one, weighted by their
// angles: then it does not matter how faces were cut into triangles. G. Thuermer, C. A. Wuethrich, Computing
// Vertex Normals from Polygonal Facets, Journal of Graphics Tools 3(1), 1998.
Vec3 cornerNormal(const Triangle& of, uint32_t corner, std::span<const uint32_t> around,
                  std::span<const Triangle> triangles, std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const uint32_t t : around)
    if (triangles[t].normal.dot(of.normal) > kCosFeatureAngle)
      sum += angleAt(triangles[t], corner, points) * triangles[t].normal;
  const float length = sum.norm();
  return length > 0.0f ? Vec3(sum / length) : of.normal;
}

}  // namespace

MeshData makeMesh(std::span<const Vec3> points, std::span<const uint32_t> indices) {
  std::vector<Triangle> triangles = collectTriangles(points, indices);
  markFeatureEdges(triangles);

  std::vector<std::vector<uint32_t>> around(points.size());
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (const uint32_t c : triangles[t].corner) around[c].push_back(t);

  MeshData mesh;
  mesh.vertices.reserve(3 * triangles.size());
  mesh.indices.reserve(3 * triangles.size());
  constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> place(points.size(), kNone);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      uint32_t& index = place[t.corner[k]];
      if (index == kNone) {
        index = uint32_t(mesh.positions.size());
        mesh.positions.push_back(points[t.corner[k]]);
      }
      mesh.indices.push_back(index);
      Vec3 edge = Vec3::Zero();
      edge[k] = 1.0f;
      for (int e = 0; e < 3; ++e)
        if (!t.feature[e]) edge[e] += kPlainEdge;
      mesh.vertices.push_back(
          {points[t.corner[k]], cornerNormal(t, t.corner[k], around[t.corner[k]], triangles, points), edge});
    }
  for (const MeshVertex& v : mesh.vertices) mesh.bounds.extend(v.position);
  return mesh;
}

void MeshData::append(const MeshData& other) {
  const auto first = uint32_t(positions.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  for (const uint32_t index : other.indices) indices.push_back(first + index);
  bounds.extend(other.bounds);
}

MeshData makeUnitBox() {
  std::array<Vec3, 8> p;
  for (int i = 0; i < 8; ++i) p[i] = Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  constexpr std::array<uint32_t, 36> kIndices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                                 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return makeMesh(p, kIndices);
}

MeshData makeUnitCylinder() {
  constexpr uint32_t kSides = 32;
  std::vector<Vec3> p;
  for (uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    const float y = float(std::cos(angle)), z = float(std::sin(angle));
    p.push_back({-1, y, z});
    p.push_back({1, y, z});
  }
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < kSides; ++i) {
    const uint32_t a = 2 * i, b = 2 * ((i + 1) % kSides);
    indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    if (i >= 1 && i + 1 < kSides) indices.insert(indices.end(), {0, b, a, 1, a + 1, b + 1});
  }
  return makeMesh(p, indices);
}

}  // namespace viewer
