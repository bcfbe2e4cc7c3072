// The traversal, written once for every instruction set. Include it only in the kernels' own sources.
//
// Triangles: S. Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013. The signs of the three
// edge functions decide; neighbours compute exactly opposite values on their common edge, so no ray slips between.
// Boxes: slabs, with the start of the ray moved by the rounding error of everything that follows (T. Ize, Robust BVH
// Ray Traversal, JCGT 2(2), 2013).
#pragma once

#include <emmintrin.h>

#include <type_traits>

#include "pfx/base_level/ray/mesh_ray.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// `Isa` names the instruction set and supplies the box test; it makes every function of this struct unique to the
// source that instantiates it.
template <class Isa, bool quantized>
struct MeshRayKernel {
  struct Lanes3 {
    __m128 axis[3];
  };

  static __m128 vertex(const MeshRayView& m, uint32_t facet, int corner, const QuantizedFacet* facets) {
    if constexpr (quantized) {
      const uint16_t* q = m.quantized_vertices[m.vertex_blocks[facet / kMaxIslandFacets] + (&facets[facet].vertex[0])[corner]];
      const __m128 cell = _mm_cvtepi32_ps(_mm_set_epi32(0, q[2], q[1], q[0]));
      return _mm_add_ps(_mm_loadu_ps(m.origin), _mm_mul_ps(_mm_loadu_ps(m.scale), cell));
    } else {
      return _mm_loadu_ps(m.vertices + 4 * static_cast<size_t>(m.triangles[facet][corner]));
    }
  }

  // One corner of four facets, axis by axis, relative to the start of the ray.
  static Lanes3 corners(const MeshRayView& m, const MeshRay& ray, const uint32_t* facets, int corner) {
    const auto* q = reinterpret_cast<const QuantizedFacet*>(m.quantized_facets);
    __m128 a = vertex(m, facets[0], corner, q), b = vertex(m, facets[1], corner, q);
    __m128 c = vertex(m, facets[2], corner, q), d = vertex(m, facets[3], corner, q);
    const __m128 ab_lo = _mm_unpacklo_ps(a, b), ab_hi = _mm_unpackhi_ps(a, b);
    const __m128 cd_lo = _mm_unpacklo_ps(c, d), cd_hi = _mm_unpackhi_ps(c, d);
    return {{_mm_sub_ps(_mm_movelh_ps(ab_lo, cd_lo), _mm_set1_ps(ray.start[0])),
             _mm_sub_ps(_mm_movehl_ps(cd_lo, ab_lo), _mm_set1_ps(ray.start[1])),
             _mm_sub_ps(_mm_movelh_ps(ab_hi, cd_hi), _mm_set1_ps(ray.start[2]))}};
  }

  // The corner seen along the ray: x and y across, z along it (fraction of the ray).
  struct Sheared {
    __m128 x, y, z;
  };
  static Sheared shear(const MeshRay& ray, const Lanes3& v) {
    const __m128 z = v.axis[ray.kz];
    return {_mm_sub_ps(v.axis[ray.kx], _mm_mul_ps(_mm_set1_ps(ray.sx), z)),
            _mm_sub_ps(v.axis[ray.ky], _mm_mul_ps(_mm_set1_ps(ray.sy), z)), _mm_mul_ps(_mm_set1_ps(ray.sz), z)};
  }

  static __m128 edge(const Sheared& p, const Sheared& q) {
    return _mm_sub_ps(_mm_mul_ps(p.x, q.y), _mm_mul_ps(p.y, q.x));
  }

  static float lane(__m128 v, int i) {
    alignas(16) float f[4];
    _mm_store_ps(f, v);
    return f[i];
  }

  // Products of floats are exact in double: where a float edge function vanished, this one tells the true side.
  static __m128 exactEdge(const Sheared& p, const Sheared& q) {
    alignas(16) float r[4];
    for (int i = 0; i < 4; ++i) {
      r[i] = static_cast<float>(static_cast<double>(lane(p.x, i)) * lane(q.y, i) -
                                static_cast<double>(lane(p.y, i)) * lane(q.x, i));
    }
    return _mm_load_ps(r);
  }

  // Lanes seen so much from the side that rounding may have opened a facet that lies in the plane of the ray.
  static int edgeOn(const Sheared& a, const Sheared& b, const Sheared& c, __m128 det) {
    const __m128 sign = _mm_set1_ps(-0.0f);
    const auto size = [&](const Sheared& p) { return _mm_max_ps(_mm_andnot_ps(sign, p.x), _mm_andnot_ps(sign, p.y)); };
    const __m128 reach = _mm_max_ps(size(a), _mm_max_ps(size(b), size(c)));
    const __m128 limit = _mm_mul_ps(_mm_set1_ps(1e-4f), _mm_mul_ps(reach, reach));
    return _mm_movemask_ps(_mm_cmple_ps(_mm_andnot_ps(sign, det), limit));
  }

  // True if the facet's plane meets the ray between its ends, by doubles. False for a ray in that plane.
  static bool insideEnds(const MeshRayView& m, const MeshRay& ray, uint32_t facet) {
    const auto* q = reinterpret_cast<const QuantizedFacet*>(m.quantized_facets);
    double v[3][3], n[3];
    for (int c = 0; c < 3; ++c) {
      alignas(16) float f[4];
      _mm_store_ps(f, vertex(m, facet, c, q));
      for (int a = 0; a < 3; ++a) v[c][a] = f[a];
    }
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      n[a] = (v[1][b] - v[0][b]) * (v[2][c] - v[0][c]) - (v[1][c] - v[0][c]) * (v[2][b] - v[0][b]);
    }
    double gap = 0.0, speed = 0.0;
    for (int a = 0; a < 3; ++a) gap += n[a] * (v[0][a] - ray.exact_start[a]), speed += n[a] * ray.exact_direction[a];
    const double t = gap / speed;
    return t >= 0.0 && t <= ray.max_fraction;
  }

  struct Candidate {
    uint32_t facet;
    float t;
    bool doubtful;
  };

  static void accept(const MeshRayView& m, const MeshRay& ray, const Candidate& c, MeshRayHit& hit) {
    if (c.t > hit.t) return;
    if (c.t == hit.t && hit.facet != kNoFacet && m.source[c.facet] >= m.source[hit.facet]) return;
    if ((c.doubtful || c.t < 1e-5f || c.t > 0.99999f) && !insideEnds(m, ray, c.facet)) return;
    hit.t = c.t;
    hit.facet = c.facet;
  }

  static void leaf(const MeshRayView& m, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit) {
    uint32_t facets[4];
    for (uint32_t i = 0; i < 4; ++i) facets[i] = first + (i < count ? i : count - 1);
    const Sheared a = shear(ray, corners(m, ray, facets, 0));
    const Sheared b = shear(ray, corners(m, ray, facets, 1));
    const Sheared c = shear(ray, corners(m, ray, facets, 2));
    __m128 u = edge(c, b), v = edge(a, c), w = edge(b, a);
    const __m128 zero = _mm_setzero_ps();
    const __m128 vanished = _mm_or_ps(_mm_cmpeq_ps(u, zero), _mm_or_ps(_mm_cmpeq_ps(v, zero), _mm_cmpeq_ps(w, zero)));
    if (_mm_movemask_ps(vanished) != 0) u = exactEdge(c, b), v = exactEdge(a, c), w = exactEdge(b, a);

    const __m128 lowest = _mm_min_ps(u, _mm_min_ps(v, w)), highest = _mm_max_ps(u, _mm_max_ps(v, w));
    const __m128 positive = _mm_cmpge_ps(lowest, zero), negative = _mm_cmple_ps(highest, zero);
    const __m128 det = _mm_add_ps(u, _mm_add_ps(v, w));
    const __m128 counts = _mm_or_ps(_mm_and_ps(positive, _mm_castsi128_ps(_mm_set1_epi32(static_cast<int>(ray.front)))),
                                    _mm_and_ps(negative, _mm_castsi128_ps(_mm_set1_epi32(static_cast<int>(ray.back)))));
    __m128 hits = _mm_and_ps(counts, _mm_cmpneq_ps(det, zero));
    if (_mm_movemask_ps(hits) == 0) return;
    const __m128 scaled = _mm_add_ps(_mm_mul_ps(u, a.z), _mm_add_ps(_mm_mul_ps(v, b.z), _mm_mul_ps(w, c.z)));
    const __m128 t = _mm_div_ps(scaled, det);
    hits = _mm_and_ps(hits, _mm_and_ps(_mm_cmpge_ps(t, _mm_set1_ps(-1e-6f)), _mm_cmple_ps(t, _mm_set1_ps(hit.t))));
    int mask = _mm_movemask_ps(hits) & ((1 << count) - 1);
    if (mask == 0) return;
    alignas(16) float fraction[4];
    _mm_store_ps(fraction, t);
    const int doubtful = edgeOn(a, b, c, det);
    for (; mask != 0; mask &= mask - 1) {
      const int i = __builtin_ctz(static_cast<unsigned>(mask));
      accept(m, ray, {facets[i], fraction[i], (doubtful >> i & 1) != 0}, hit);
    }
  }

  // Memory is slower than everything else here: ask for a child when it is found, not when it is opened.
  template <class Node>
  static void prefetch(const MeshRayView& m, const Node* nodes, MeshChild child) {
    if (isLeaf(child)) {
      if constexpr (quantized) {
        prefetchLine(m.quantized_facets + sizeof(QuantizedFacet) * leafFirst(child));
        prefetchLine(m.vertex_blocks + leafFirst(child) / kMaxIslandFacets);
      } else {
        prefetchLine(m.triangles + leafFirst(child));
      }
    } else {
      const char* node = reinterpret_cast<const char*>(nodes + child);
      for (size_t line = 0; line < sizeof(Node); line += 64) prefetchLine(node + line);
    }
  }
  static void prefetchLine(const void* p) { _mm_prefetch(static_cast<const char*>(p), _MM_HINT_T0); }

  struct Entry {
    MeshChild child;
    float t;
  };
  // Eight-wide nodes of a tree at most 64 deep leave at most 7 siblings a level.
  static constexpr int kStack = 7 * 64 + 8;

  // A ray half way.
  struct Journey {
    Entry next = {0, 0.0f};
    int size = 0;
    Entry stack[kStack];
    Journey() {}
  };

  // The nearer of two children, the other one on the stack.
  static Entry nearerOf(const Entry& a, const Entry& b, Journey& journey) {
    const bool swap = b.t < a.t;
    journey.stack[journey.size++] = swap ? a : b;
    return swap ? b : a;
  }

  // Puts what the ray meets of a node on the stack, but for the nearest child, which it returns; kNoChild: none. Rays
  // mostly meet one or two, and a sort would only mislead the processor's guesses.
  static Entry open(const MeshRayView& m, const MeshRay& ray, uint32_t index, float t_max, Journey& journey) {
    using Node = typename Isa::template NodeType<quantized>;
    const auto* nodes = reinterpret_cast<const Node*>(m.nodes);
    const Node& node = nodes[index];
    alignas(32) float t_near[8];
    unsigned mask = Isa::testBoxes(node.bounds, m, ray, t_max, t_near);
    const auto next = [&] {
      const int i = __builtin_ctz(mask);
      mask &= mask - 1;
      if (node.child[i] != kNoChild) prefetch(m, nodes, node.child[i]);
      return Entry{node.child[i], t_near[i]};
    };
    if (mask == 0) return {kNoChild, 0.0f};
    const Entry first = next();
    if (mask == 0) return first;
    const Entry second = next();
    if (second.child == kNoChild) return first;
    const int bottom = journey.size;
    Entry nearest = nearerOf(first, second, journey);
    while (mask != 0) {
      const Entry child = next();
      if (child.child == kNoChild) break;
      const Entry far = child.t < nearest.t ? nearest : child;
      nearest = child.t < nearest.t ? child : nearest;
      int place = journey.size++;
      for (; place > bottom && journey.stack[place - 1].t < far.t; --place) {
        journey.stack[place] = journey.stack[place - 1];
      }
      journey.stack[place] = far;
    }
    return nearest;
  }

  // Opens a node, or tests a leaf, and goes on to the nearest that the ray still has before it.
  static void step(const MeshRayView& m, const MeshRay& ray, Journey& journey, MeshRayHit& hit) {
    const MeshChild here = journey.next.child;
    if (isLeaf(here)) {
      leaf(m, ray, leafFirst(here), leafCount(here), hit);
      journey.next.child = kNoChild;
    } else {
      journey.next = open(m, ray, here, hit.t, journey);
    }
    while (journey.next.child == kNoChild && journey.size > 0) {
      journey.next = journey.stack[--journey.size];
      if (journey.next.t > hit.t) journey.next.child = kNoChild;
    }
  }

  static void trace(const MeshRayView& m, const MeshRay& ray, MeshRayHit& hit) {
    Journey journey;
    while (journey.next.child != kNoChild) step(m, ray, journey, hit);
  }

  // Several rays in turn, one step each, so that each waits for memory while the others compute.
  static void traceMany(const MeshRayView& m, const MeshRay* rays, MeshRayHit* hits, int count) {
    Journey journeys[kMaxTogether];
    int active[kMaxTogether];
    for (int i = 0; i < count; ++i) active[i] = i;
    while (count > 0) {
      for (int k = 0; k < count;) {
        const int i = active[k];
        step(m, rays[i], journeys[i], hits[i]);
        if (journeys[i].next.child != kNoChild) {
          ++k;
        } else {
          active[k] = active[--count];
        }
      }
    }
  }
};

}  // namespace pfx
