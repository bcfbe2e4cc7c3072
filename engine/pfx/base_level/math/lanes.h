// Eight floats worked on together: one AVX2 register, or two SSE2 registers.
//
// A kernel is written once over F8 and compiled in two files, one of them for AVX2; the file that includes
// this header decides. Both bodies do the same operation on each lane in the same order, so that results have
// the same bits. No approximate reciprocals and no fused multiply-add for the same reason.
//
// A file compiled for AVX2 must include nothing that has inline functions shared with other files, since the
// linker could keep the AVX2 copy for everyone. Hence the namespaces, and hence no Eigen here.
#pragma once

#include <immintrin.h>

#include <cstdint>

#if defined(__AVX2__)
#define PFX_LANES lanes_avx2
#else
#define PFX_LANES lanes_sse2
#endif

namespace pfx::PFX_LANES {

inline constexpr int kLanes = 8;

#if defined(__AVX2__)

struct F8 {
  __m256 v;
  static F8 load(const float* p) { return {_mm256_load_ps(p)}; }
  static F8 set(float x) { return {_mm256_set1_ps(x)}; }
  static F8 zero() { return {_mm256_setzero_ps()}; }
  void store(float* p) const { _mm256_store_ps(p, v); }
};
inline F8 operator+(F8 a, F8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F8 operator-(F8 a, F8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline F8 operator*(F8 a, F8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline F8 operator/(F8 a, F8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline F8 operator&(F8 a, F8 b) { return {_mm256_and_ps(a.v, b.v)}; }
inline F8 operator|(F8 a, F8 b) { return {_mm256_or_ps(a.v, b.v)}; }
inline F8 min(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline F8 max(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline F8 sqrt(F8 a) { return {_mm256_sqrt_ps(a.v)}; }
inline F8 operator<(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline F8 operator>(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
// mask ? a : b, mask all ones or all zeros in each lane
inline F8 select(F8 mask, F8 a, F8 b) { return {_mm256_blendv_ps(b.v, a.v, mask.v)}; }
inline bool anyTrue(F8 mask) { return _mm256_movemask_ps(mask.v) != 0; }

// Transposes eight rows of eight floats, rows[i] = 32 aligned bytes, into eight lanes vectors.
inline void loadTransposed(const float* const rows[8], F8 out[8]) {
  __m256 r[8], t[8];
  for (int i = 0; i < 8; ++i) r[i] = _mm256_load_ps(rows[i]);
  for (int i = 0; i < 4; ++i) {
    t[2 * i] = _mm256_unpacklo_ps(r[2 * i], r[2 * i + 1]);
    t[2 * i + 1] = _mm256_unpackhi_ps(r[2 * i], r[2 * i + 1]);
  }
  for (int i = 0; i < 2; ++i) {
    r[4 * i] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
    r[4 * i + 1] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0xee);
    r[4 * i + 2] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
    r[4 * i + 3] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xee);
  }
  for (int i = 0; i < 4; ++i) {
    out[i].v = _mm256_permute2f128_ps(r[i], r[i + 4], 0x20);
    out[i + 4].v = _mm256_permute2f128_ps(r[i], r[i + 4], 0x31);
  }
}

// The inverse: eight lane vectors to eight rows. A null row is skipped.
inline void storeTransposed(const F8 in[8], float* const rows[8]) {
  alignas(32) float columns[8][8];
  const float* sources[8];
  for (int i = 0; i < 8; ++i) {
    in[i].store(columns[i]);
    sources[i] = columns[i];
  }
  F8 out[8];
  loadTransposed(sources, out);
  for (int i = 0; i < 8; ++i)
    if (rows[i]) out[i].store(rows[i]);
}

#else

struct F8 {
  __m128 lo, hi;
  static F8 load(const float* p) { return {_mm_load_ps(p), _mm_load_ps(p + 4)}; }
  static F8 set(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
  static F8 zero() { return {_mm_setzero_ps(), _mm_setzero_ps()}; }
  void store(float* p) const { _mm_store_ps(p, lo), _mm_store_ps(p + 4, hi); }
};
inline F8 operator+(F8 a, F8 b) { return {_mm_add_ps(a.lo, b.lo), _mm_add_ps(a.hi, b.hi)}; }
inline F8 operator-(F8 a, F8 b) { return {_mm_sub_ps(a.lo, b.lo), _mm_sub_ps(a.hi, b.hi)}; }
inline F8 operator*(F8 a, F8 b) { return {_mm_mul_ps(a.lo, b.lo), _mm_mul_ps(a.hi, b.hi)}; }
inline F8 operator/(F8 a, F8 b) { return {_mm_div_ps(a.lo, b.lo), _mm_div_ps(a.hi, b.hi)}; }
inline F8 operator&(F8 a, F8 b) { return {_mm_and_ps(a.lo, b.lo), _mm_and_ps(a.hi, b.hi)}; }
inline F8 operator|(F8 a, F8 b) { return {_mm_or_ps(a.lo, b.lo), _mm_or_ps(a.hi, b.hi)}; }
inline F8 min(F8 a, F8 b) { return {_mm_min_ps(a.lo, b.lo), _mm_min_ps(a.hi, b.hi)}; }
inline F8 max(F8 a, F8 b) { return {_mm_max_ps(a.lo, b.lo), _mm_max_ps(a.hi, b.hi)}; }
inline F8 sqrt(F8 a) { return {_mm_sqrt_ps(a.lo), _mm_sqrt_ps(a.hi)}; }
inline F8 operator<(F8 a, F8 b) { return {_mm_cmplt_ps(a.lo, b.lo), _mm_cmplt_ps(a.hi, b.hi)}; }
inline F8 operator>(F8 a, F8 b) { return {_mm_cmpgt_ps(a.lo, b.lo), _mm_cmpgt_ps(a.hi, b.hi)}; }
inline __m128 select(__m128 mask, __m128 a, __m128 b) {
  return _mm_or_ps(_mm_and_ps(mask, a), _mm_andnot_ps(mask, b));
}
inline F8 select(F8 mask, F8 a, F8 b) { return {select(mask.lo, a.lo, b.lo), select(mask.hi, a.hi, b.hi)}; }
inline bool anyTrue(F8 mask) { return (_mm_movemask_ps(mask.lo) | _mm_movemask_ps(mask.hi)) != 0; }

inline void loadTransposed(const float* const rows[8], F8 out[8]) {
  for (int block = 0; block < 2; ++block) {  // columns 0..3, then 4..7
    for (int half = 0; half < 2; ++half) {   // rows 0..3, then 4..7
      __m128 a = _mm_load_ps(rows[4 * half] + 4 * block), b = _mm_load_ps(rows[4 * half + 1] + 4 * block);
      __m128 c = _mm_load_ps(rows[4 * half + 2] + 4 * block), d = _mm_load_ps(rows[4 * half + 3] + 4 * block);
      _MM_TRANSPOSE4_PS(a, b, c, d);
      const __m128 columns[4] = {a, b, c, d};
      for (int i = 0; i < 4; ++i) (half ? out[4 * block + i].hi : out[4 * block + i].lo) = columns[i];
    }
  }
}

inline void storeTransposed(const F8 in[8], float* const rows[8]) {
  for (int block = 0; block < 2; ++block) {
    for (int half = 0; half < 2; ++half) {
      __m128 r[4];
      for (int i = 0; i < 4; ++i) r[i] = half ? in[4 * block + i].hi : in[4 * block + i].lo;
      _MM_TRANSPOSE4_PS(r[0], r[1], r[2], r[3]);
      for (int i = 0; i < 4; ++i)
        if (float* row = rows[4 * half + i]) _mm_store_ps(row + 4 * block, r[i]);
    }
  }
}

#endif

inline F8 operator-(F8 a) { return F8::zero() - a; }
inline F8& operator+=(F8& a, F8 b) { return a = a + b; }
inline F8& operator-=(F8& a, F8 b) { return a = a - b; }

// Three lane vectors: eight 3-vectors.
struct V8 {
  F8 x, y, z;
  static V8 load(const float p[3][8]) { return {F8::load(p[0]), F8::load(p[1]), F8::load(p[2])}; }
  void store(float p[3][8]) const { x.store(p[0]), y.store(p[1]), z.store(p[2]); }
};
inline V8 operator+(const V8& a, const V8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V8 operator-(const V8& a, const V8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V8 operator*(F8 s, const V8& a) { return {s * a.x, s * a.y, s * a.z}; }
inline F8 dot(const V8& a, const V8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V8 cross(const V8& a, const V8& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Symmetric 3 x 3 matrices.
struct S8 {
  F8 xx, xy, xz, yy, yz, zz;
};
inline V8 operator*(const S8& m, const V8& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

// Rotation of a by the unit quaternion with vector part u and scalar part w.
inline V8 rotate(const V8& u, F8 w, const V8& a) {
  const V8 t = F8::set(2.0f) * cross(u, a);
  return a + w * t + cross(u, t);
}

}  // namespace pfx::PFX_LANES
