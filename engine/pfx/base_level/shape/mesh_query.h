// Which facets of a large mesh may meet a box.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <cmath>

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

namespace mesh_query {

// One bit per child of the node whose bounds meet the box.
struct FloatBox {
  float min[3], max[3];
  explicit FloatBox(const LargeMesh&, const Aabb& box)
      : min{box.min.x(), box.min.y(), box.min.z()}, max{box.max.x(), box.max.y(), box.max.z()} {}

  unsigned test(const MeshNode& node) const {
    unsigned mask = 0;
    for (int half = 0; half < 2; ++half) {
      __m128 meets = _mm_castsi128_ps(_mm_set1_epi32(-1));
      for (int a = 0; a < 3; ++a) {
        meets = _mm_and_ps(meets, _mm_cmple_ps(_mm_load_ps(&node.bounds[a][4 * half]), _mm_set1_ps(max[a])));
        meets = _mm_and_ps(meets, _mm_cmpge_ps(_mm_load_ps(&node.bounds[3 + a][4 * half]), _mm_set1_ps(min[a])));
      }
      mask |= static_cast<unsigned>(_mm_movemask_ps(meets)) << (4 * half);
    }
    return mask;
  }
};

// The same on the grid: the box in cells, rounded outwards.
struct CellBox {
  uint16_t min[3], max[3];
  CellBox(const LargeMesh& mesh, const Aabb& box) {
    for (int a = 0; a < 3; ++a) {
      const float o = mesh.surface_bounds.min[a], s = mesh.grid_scale[a];
      min[a] = s > 0.0f ? cell(std::floor((box.min[a] - o) / s) - 1.0f) : 0;
      max[a] = s > 0.0f ? cell(std::ceil((box.max[a] - o) / s) + 1.0f) : 65535;
    }
  }
  static uint16_t cell(float x) { return static_cast<uint16_t>(std::clamp(x, 0.0f, 65535.0f)); }

  // Saturated subtraction is zero where a <= b.
  unsigned test(const QuantizedMeshNode& node) const {
    __m128i beyond = _mm_setzero_si128();
    for (int a = 0; a < 3; ++a) {
      const __m128i lo = _mm_load_si128(reinterpret_cast<const __m128i*>(node.bounds[a]));
      const __m128i hi = _mm_load_si128(reinterpret_cast<const __m128i*>(node.bounds[3 + a]));
      beyond = _mm_or_si128(beyond, _mm_subs_epu16(lo, _mm_set1_epi16(static_cast<int16_t>(max[a]))));
      beyond = _mm_or_si128(beyond, _mm_subs_epu16(_mm_set1_epi16(static_cast<int16_t>(min[a])), hi));
    }
    const __m128i meets = _mm_cmpeq_epi16(beyond, _mm_setzero_si128());
    return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(meets, _mm_setzero_si128()))) & 0xffu;
  }
};

template <class Box, class Node, class Visit>
void visitNodes(const LargeMesh& mesh, const MeshArray<Node>& nodes, const Aabb& box, Visit&& visit) {
  const Box b(mesh, box);
  uint32_t stack[7 * 64 + 8];  // trees are at most 64 deep
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes[stack[--size]];
    for (unsigned mask = b.test(node); mask != 0; mask &= mask - 1) {
      const MeshChild child = node.child[__builtin_ctz(mask)];
      if (child == kNoChild) break;
      if (isLeaf(child)) {
        visit(leafFirst(child), leafCount(child));
      } else {
        stack[size++] = child;
      }
    }
  }
}

}  // namespace mesh_query

// Calls visit(first, count) for runs of facets that together hold every facet whose bounds meet the box (m, mesh
// frame). The order depends on the mesh alone.
template <class Visit>
void visitFacets(const LargeMesh& mesh, const Aabb& box, Visit&& visit) {
  switch (mesh.type) {
    case LargeMeshType::ExpandedBvh:
      return mesh_query::visitNodes<mesh_query::FloatBox>(mesh, mesh.nodes, box, visit);
    case LargeMeshType::QuantizedBvh:
      return mesh_query::visitNodes<mesh_query::CellBox>(mesh, mesh.quantized_nodes, box, visit);
    default:
      for (const MeshIsland& island : mesh.islands) {
        if (island.bounds.overlaps(box)) visit(island.first_facet, island.num_facets);
      }
  }
}

}  // namespace pfx
