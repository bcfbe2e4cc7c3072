// Convex hull of points as triangles.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct HullTriangle {
  std::array<int, 3> vertices;   // into the points, counter-clockwise seen from outside
  std::array<int, 3> neighbors;  // across the edge vertices[i] -> vertices[i + 1]
  Eigen::Vector3d normal;        // unit
  double offset;
};

// Points that lie at most `tolerance` outside the hull may be left out. Nothing when all points lie within
// `tolerance` of one plane. Source: C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for
// Convex Hulls, ACM TOMS 22(4), 1996.
std::optional<std::vector<HullTriangle>> quickhull(std::span<const Eigen::Vector3d> points, double tolerance);

}  // namespace pfx
