// Buckets by lowest vertex: linear time, and the same result on every machine.
#include "pfx/util/mesh_builder/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace pfx {
namespace {

// Numbers of the entries of each bucket: bucket b holds order[first[b]] .. order[first[b + 1] - 1], ascending.
struct Buckets {
  std::vector<uint32_t> first, order;
  std::span<uint32_t> of(uint32_t b) { return std::span(order).subspan(first[b], first[b + 1] - first[b]); }
};

template <class BucketOf>
Buckets sortIntoBuckets(uint32_t num_entries, uint32_t num_buckets, BucketOf&& bucket_of) {
  Buckets b;
  b.first.assign(num_buckets + 2, 0);
  b.order.resize(num_entries);
  for (uint32_t i = 0; i < num_entries; ++i) ++b.first[bucket_of(i) + 2];
  std::partial_sum(b.first.begin(), b.first.end(), b.first.begin());
  for (uint32_t i = 0; i < num_entries; ++i) b.order[b.first[bucket_of(i) + 1]++] = i;
  b.first.pop_back();
  return b;
}

uint64_t positionHash(const std::array<uint32_t, 3>& bits) {
  uint64_t h = bits[0] * 0x9e3779b97f4a7c15ull;
  h = (h ^ (h >> 32) ^ bits[1]) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 32) ^ bits[2]) * 0x94d049bb133111ebull;
  return h ^ (h >> 29);
}

// Rotated so that the lowest vertex comes first; the front stays the front.
MeshIndices canonical(const MeshIndices& t) {
  const auto lowest = std::min_element(t.begin(), t.end()) - t.begin();
  return {t[lowest], t[(lowest + 1) % 3], t[(lowest + 2) % 3]};
}

struct EdgeRef {
  uint32_t low, high;
  bool forward;  // runs from low to high
};

EdgeRef edgeRef(const MeshIndices& t, uint32_t k) {
  const uint32_t a = t[k], b = t[(k + 1) % 3];
  return {std::min(a, b), std::max(a, b), a < b};
}

}  // namespace

std::vector<uint32_t> weldVertices(std::span<const Vec3> vertices) {
  std::vector<uint32_t> first(vertices.size());
  const size_t mask = std::bit_ceil(vertices.size() * 2) - 1;
  std::vector<uint32_t> table(mask + 1, kNoFacet);
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    const Vec3& v = vertices[i];
    const std::array<uint32_t, 3> bits = {std::bit_cast<uint32_t>(v.x() + 0.0f), std::bit_cast<uint32_t>(v.y() + 0.0f),
                                          std::bit_cast<uint32_t>(v.z() + 0.0f)};
    size_t slot = positionHash(bits) & mask;
    while (table[slot] != kNoFacet && vertices[table[slot]] != v) slot = (slot + 1) & mask;
    if (table[slot] == kNoFacet) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Eigen::Vector3d u = (b - a).cast<double>(), v = (c - a).cast<double>(), w = (c - b).cast<double>();
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  // Twice the area against the longest side squared: a height of 1e-7 of the longest side is what the rounding of
  // float coordinates alone can make.
  return !(u.cross(v).norm() > 1e-7 * longest);
}

uint32_t dropDuplicates(std::vector<MeshIndices>& triangles, std::vector<uint32_t>& source, uint32_t num_vertices) {
  const uint32_t n = static_cast<uint32_t>(triangles.size());
  Buckets buckets =
      sortIntoBuckets(n, num_vertices, [&](uint32_t i) { return std::min({triangles[i][0], triangles[i][1], triangles[i][2]}); });
  std::vector<uint8_t> repeated(n, 0);
  for (uint32_t v = 0; v < num_vertices; ++v) {
    const auto bucket = buckets.of(v);
    std::stable_sort(bucket.begin(), bucket.end(),
                     [&](uint32_t a, uint32_t b) { return canonical(triangles[a]) < canonical(triangles[b]); });
    for (size_t i = 1; i < bucket.size(); ++i) {
      repeated[bucket[i]] = canonical(triangles[bucket[i]]) == canonical(triangles[bucket[i - 1]]);
    }
  }
  uint32_t kept = 0;
  for (uint32_t i = 0; i < n; ++i) {
    if (repeated[i]) continue;
    triangles[kept] = triangles[i];
    source[kept++] = source[i];
  }
  triangles.resize(kept);
  source.resize(kept);
  return n - kept;
}

std::vector<MeshIndices> findNeighbors(std::span<const MeshIndices> triangles, uint32_t num_vertices) {
  const uint32_t n = static_cast<uint32_t>(triangles.size());
  std::vector<MeshIndices> neighbors(n, {kNoFacet, kNoFacet, kNoFacet});
  // Entry 3 f + k is edge k of triangle f.
  const auto ref = [&](uint32_t entry) { return edgeRef(triangles[entry / 3], entry % 3); };
  Buckets buckets = sortIntoBuckets(3 * n, num_vertices, [&](uint32_t i) { return ref(i).low; });
  for (uint32_t v = 0; v < num_vertices; ++v) {
    const auto bucket = buckets.of(v);
    std::stable_sort(bucket.begin(), bucket.end(), [&](uint32_t a, uint32_t b) { return ref(a).high < ref(b).high; });
    for (size_t i = 0; i < bucket.size();) {
      size_t end = i + 1;
      while (end < bucket.size() && ref(bucket[end]).high == ref(bucket[i]).high) ++end;
      if (end - i == 2 && ref(bucket[i]).forward != ref(bucket[i + 1]).forward) {
        const uint32_t a = bucket[i], b = bucket[i + 1];
        neighbors[a / 3][a % 3] = b / 3 << 2 | b % 3;
        neighbors[b / 3][b % 3] = a / 3 << 2 | a % 3;
      }
      i = end;
    }
  }
  return neighbors;
}

}  // namespace pfx
