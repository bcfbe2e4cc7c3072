// Eight boxes at once. Compiled for AVX2; called only where the processor has it.
#include "pfx/base_level/ray/mesh_ray_kernel.h"

#include <immintrin.h>

namespace pfx {
namespace {

struct Avx2 {
  template <bool quantized>
  using NodeType = std::conditional_t<quantized, QuantizedMeshNode, MeshNode>;

  static __m256 row(const float (&bounds)[6][8], const MeshRayView&, uint32_t r) { return _mm256_loadu_ps(bounds[r]); }
  static __m256 row(const uint16_t (&bounds)[6][8], const MeshRayView& m, uint32_t r) {
    const __m128i cells = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bounds[r]));
    const __m256 wide = _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(cells));
    return _mm256_add_ps(_mm256_set1_ps(m.origin[r % 3]), _mm256_mul_ps(_mm256_set1_ps(m.scale[r % 3]), wide));
  }

  template <class Bounds>
  static unsigned testBoxes(const Bounds& bounds, const MeshRayView& m, const MeshRay& ray, float t_max, float* t_near) {
    __m256 enter = _mm256_setzero_ps(), leave = _mm256_set1_ps(t_max);
    for (int a = 0; a < 3; ++a) {
      const __m256 inverse = _mm256_set1_ps(ray.inverse[a]);
      const __m256 lo = row(bounds, m, ray.near_row[a]), hi = row(bounds, m, ray.far_row[a]);
      enter = _mm256_max_ps(enter, _mm256_mul_ps(_mm256_sub_ps(lo, _mm256_set1_ps(ray.near_start[a])), inverse));
      leave = _mm256_min_ps(leave, _mm256_mul_ps(_mm256_sub_ps(hi, _mm256_set1_ps(ray.far_start[a])), inverse));
    }
    _mm256_store_ps(t_near, enter);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(enter, leave, _CMP_LE_OQ)));
  }
};

}  // namespace

void traceExpandedAvx2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit) {
  MeshRayKernel<Avx2, false>::trace(mesh, ray, hit);
}
void traceQuantizedAvx2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit) {
  MeshRayKernel<Avx2, true>::trace(mesh, ray, hit);
}
void traceManyExpandedAvx2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count) {
  MeshRayKernel<Avx2, false>::traceMany(mesh, rays, hits, count);
}
void traceManyQuantizedAvx2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count) {
  MeshRayKernel<Avx2, true>::traceMany(mesh, rays, hits, count);
}

}  // namespace pfx
