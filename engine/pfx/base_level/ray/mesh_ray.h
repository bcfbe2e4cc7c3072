// A ray on its way through the hierarchy of a large mesh, and the kernels that take it there.
//
// Kernels exist for SSE2 and AVX2. They differ in how many boxes one instruction tests; every float they compute is
// the same, and ties go to the lowest source triangle, so that the hit does not depend on which one ran.
#pragma once

#include <cstdint>

#include "pfx/base_level/ray/ray.h"

namespace pfx {

// Arrays of the mesh as plain pointers; a kernel may be compiled for other instructions than its caller and must not
// share inline functions with it.
struct MeshRayView {
  const char* nodes = nullptr;          // MeshNode or QuantizedMeshNode
  const float* vertices = nullptr;      // 4 floats each
  const uint32_t (*triangles)[3] = nullptr;
  const uint16_t (*quantized_vertices)[3] = nullptr;
  const uint32_t* vertex_blocks = nullptr;
  const char* quantized_facets = nullptr;
  const uint32_t* source = nullptr;
  float origin[4] = {}, scale[4] = {};  // of the grid
};

// The part of a ray inside the bounds of the mesh, fractions 0 .. 1.
struct MeshRay {
  float start[3], direction[3];
  float near_start[3], far_start[3];  // start moved outwards and inwards, so that rounding never loses a box
  float inverse[3];                   // of direction; large where that is zero
  uint32_t near_row[3], far_row[3];   // rows of the node's bounds that the ray meets first and last
  int kx, ky, kz;                     // axes: kz the longest of the direction
  float sx, sy, sz;                   // shear that maps the direction to (0, 0, 1)
  uint32_t front = 0, back = 0;       // all ones when such facets count
  // The ray itself, to decide exactly at its ends.
  double exact_start[3], exact_direction[3], max_fraction;
};

struct MeshRayHit {
  float t = 1.000001f;
  uint32_t facet = 0xffffffffu;
};

// Nearest hit among all facets under the root.
void traceExpandedSse2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit);
void traceQuantizedSse2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit);
void traceExpandedAvx2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit);
void traceQuantizedAvx2(const MeshRayView& mesh, const MeshRay& ray, MeshRayHit& hit);

// The same for several rays at once, at most kMaxTogether.
inline constexpr int kMaxTogether = 16;
void traceManyExpandedSse2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count);
void traceManyQuantizedSse2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count);
void traceManyExpandedAvx2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count);
void traceManyQuantizedAvx2(const MeshRayView& mesh, const MeshRay* rays, MeshRayHit* hits, int count);

// The hit of one of the kernels above, from the same preparation as castRay(); for tests and benchmarks.
using MeshRayTrace = void (*)(const MeshRayView&, const MeshRay&, MeshRayHit&);
MeshRayHit traceWith(MeshRayTrace trace, const LargeMesh& mesh, const LocalRay& ray);

// Nearest hit among a run of facets, for meshes without hierarchy.
void traceRunExpanded(const MeshRayView& mesh, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit);
void traceRunQuantized(const MeshRayView& mesh, const MeshRay& ray, uint32_t first, uint32_t count, MeshRayHit& hit);

}  // namespace pfx
