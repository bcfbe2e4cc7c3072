// Searches over a polytope, and the polytope of a box: fixed topology, vertices from the half extents.
#include "pfx/base_level/shape/polytope.h"

#include <emmintrin.h>

#include <algorithm>
#include <limits>

namespace pfx {
namespace {

// Vertex i has sign + on axis k when bit k of i is set. Face 2k looks along +k, face 2k + 1 along -k.
constexpr uint16_t kFaceVertices[24] = {1, 3, 7, 5, 0, 4, 6, 2, 2, 6, 7, 3,
                                        0, 1, 5, 4, 4, 5, 7, 6, 0, 2, 3, 1};
constexpr PolytopeFace kFaces[6] = {{0, 4}, {4, 4}, {8, 4}, {12, 4}, {16, 4}, {20, 4}};
constexpr PolytopeEdge kEdges[12] = {{0, 1, 3, 5}, {3, 2, 2, 5}, {5, 4, 3, 4}, {6, 7, 2, 4},
                                     {2, 0, 1, 5}, {1, 3, 0, 5}, {4, 6, 1, 4}, {7, 5, 0, 4},
                                     {0, 4, 1, 3}, {5, 1, 0, 3}, {6, 2, 1, 2}, {3, 7, 0, 2}};

// Index of the vector with the largest product with d; the lowest of equal ones. SSE2 is part of every
// x86-64, and multiplies and adds in the order of the plain loop below.
uint32_t largestProduct(std::span<const Vec3x4> packed, const Vec3& d) {
  const __m128 dx = _mm_set1_ps(d.x()), dy = _mm_set1_ps(d.y()), dz = _mm_set1_ps(d.z());
  __m128 best = _mm_set1_ps(-std::numeric_limits<float>::infinity());
  __m128i best_index = _mm_setzero_si128(), index = _mm_setr_epi32(0, 1, 2, 3);
  for (const Vec3x4& v : packed) {
    const __m128 xy = _mm_add_ps(_mm_mul_ps(_mm_load_ps(v.x), dx), _mm_mul_ps(_mm_load_ps(v.y), dy));
    const __m128 product = _mm_add_ps(xy, _mm_mul_ps(_mm_load_ps(v.z), dz));
    const __m128i larger = _mm_castps_si128(_mm_cmpgt_ps(product, best));
    best = _mm_max_ps(product, best);
    best_index = _mm_or_si128(_mm_and_si128(larger, index), _mm_andnot_si128(larger, best_index));
    index = _mm_add_epi32(index, _mm_set1_epi32(4));
  }
  alignas(16) float value[4];
  alignas(16) uint32_t place[4];
  _mm_store_ps(value, best);
  _mm_store_si128(reinterpret_cast<__m128i*>(place), best_index);
  int lane = 0;
  for (int k = 1; k < 4; ++k) {
    if (value[k] > value[lane] || (value[k] == value[lane] && place[k] < place[lane])) lane = k;
  }
  return place[lane];
}

float product(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

}  // namespace

std::vector<Vec3x4> packFours(std::span<const Vec3> vectors) {
  std::vector<Vec3x4> packed((vectors.size() + 3) / 4);
  for (size_t i = 0; i < 4 * packed.size(); ++i) {
    const Vec3& v = vectors[std::min(i, vectors.size() - 1)];
    packed[i / 4].x[i % 4] = v.x(), packed[i / 4].y[i % 4] = v.y(), packed[i / 4].z[i % 4] = v.z();
  }
  return packed;
}

uint32_t farthestVertex(const Polytope& polytope, const Vec3& direction) {
  if (!polytope.packed_vertices.empty()) return largestProduct(polytope.packed_vertices, direction);
  uint32_t best = 0;
  float reach = product(polytope.vertices[0], direction);
  for (uint32_t i = 1; i < polytope.vertices.size(); ++i) {
    const float r = product(polytope.vertices[i], direction);
    if (r > reach) reach = r, best = i;
  }
  return best;
}

uint32_t supportingFace(const Polytope& polytope, const Vec3& direction) {
  if (!polytope.packed_normals.empty()) return largestProduct(polytope.packed_normals, direction);
  uint32_t best = 0;
  float cosine = product(polytope.planes[0].normal, direction);
  for (uint32_t f = 1; f < polytope.planes.size(); ++f) {
    const float c = product(polytope.planes[f].normal, direction);
    if (c > cosine) cosine = c, best = f;
  }
  return best;
}

BoxPolytope::BoxPolytope(const Vec3& h) : inner_radius(h.minCoeff()) {
  for (int i = 0; i < 8; ++i) {
    vertices[i] = Vec3(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z());
  }
  for (int f = 0; f < 6; ++f) {
    planes[f].normal = Vec3::Zero();
    planes[f].normal[f / 2] = f & 1 ? -1.0f : 1.0f;
    planes[f].offset = h[f / 2];
  }
}

Polytope BoxPolytope::view() const {
  return {vertices, planes, kFaces, kFaceVertices, kEdges, Vec3::Zero(), inner_radius, {}, {}};
}

}  // namespace pfx
