// Eight boxes as two halves of four.
#include "pfx/base_level/ray/mesh_ray_kernel.h"

namespace pfx {
namespace {

struct Sse2 {
  template <bool quantized>
  using NodeType = std::conditional_t<quantized, QuantizedMeshNode, MeshNode>;

  static __m128 row(const float (&bounds)[6][8], const MeshRayView&, uint32_t r, int half) {
    return _mm_loadu_ps(&bounds[r][4 * half]);
  }
  static __m128 row(const uint16_t (&bounds)[6][8], const MeshRayView& m, uint32_t r, int half) {
    const __m128i cells = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&bounds[r][4 * half]));
    const __m128 wide = _mm_cvtepi32_ps(_mm_unpacklo_epi16(cells, _mm_setzero_si128()));
    return _mm_add_ps(_mm_set1_ps(m.origin[r % 3]), _mm_mul_ps(_mm_set1_ps(m.scale[r % 3]), wide));
  }

  template <class Bounds>
  static unsigned testBoxes(const Bounds& bounds, const MeshRayView& m, const MeshRay& ray, float t_max, float* t_near) {
    unsigned mask = 0;
    for (int half = 0; half < 2; ++half) {
      __m128 enter = _mm_setzero_ps(), leave = _mm_set1_ps(t_max);
      for (int a = 0; a < 3; ++a) {
        const __m128 inverse = _mm_set1_ps(ray.inverse[a]);
        const __m128 lo = row(bounds, m, ray.near_row[a], half), hi = row(bounds, m, ray.far_row[a], half);
        enter = _mm_max_ps(enter, _mm_mul_ps(_mm_sub_ps(lo, _mm_set1_ps(ray.near_start[a])), inverse));
        leave = _mm_min_ps(leave, _mm_mul_ps(_mm_sub_ps(hi, _mm_set1_ps(ray.far_start[a])), inverse));
      }
      _mm_store_ps(t_near + 4 * half, enter);
      mask |= static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(enter, leave))) << (4 * half);
    }
    return mask;
  }
};

}  // namespace

void traceExpandedSse2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit) {
  MeshRayKernel<Sse2, false>::trace(mesh, ray, hit);
}
void traceQuantizedSse2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit) {
  MeshRayKernel<Sse2, true>::trace(mesh, ray, hit);
}
void traceManyExpandedSse2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count) {
  MeshRayKernel<Sse2, false>::traceMany(mesh, rays, hits, count);
}
void traceManyQuantizedSse2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count) {
  MeshRayKernel<Sse2, true>::traceMany(mesh, rays, hits, count);
}

namespace {

template <bool quantized>
void traceRun(const MeshRayView& mesh, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit) {
  for (uint32_t i = 0; i < count; i += kMaxLeafFacets) {
    const uint32_t n = count - i < kMaxLeafFacets ? count - i : kMaxLeafFacets;
    MeshRayKernel<Sse2, quantized>::leaf(mesh, ray, first + i, n, hit);
  }
}

}  // namespace

void traceRunExpanded(const MeshRayView& mesh, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit) {
  traceRun<false>(mesh, ray, first, count, hit);
}
void traceRunQuantized(const MeshRayView& mesh, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit) {
  traceRun<true>(mesh, ray, first, count, hit);
}

}  // namespace pfx
