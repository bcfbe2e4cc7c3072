// What a triangle soup means: which vertices are one, which triangles count, which are neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// For each vertex the first vertex at exactly the same position (-0 equals 0).
std::vector<uint32_t> weldVertices(std::span<const Vec3> vertices);

// True if the corners span no area: two coincide or the three lie on a line to within rounding.
bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c);

// Drops each triangle that repeats an earlier one (same corners, same front). `triangles` and `source` shrink
// together; returns the number dropped.
uint32_t dropDuplicates(std::vector<MeshIndices>& triangles, std::vector<uint32_t>& source, uint32_t num_vertices);

// For each edge k (vertex k to k + 1) of each triangle: neighbour << 2 | its edge, or kNoFacet unless exactly one
// other triangle runs through the edge the other way.
std::vector<MeshIndices> findNeighbors(std::span<const MeshIndices> triangles, uint32_t num_vertices);

}  // namespace pfx
