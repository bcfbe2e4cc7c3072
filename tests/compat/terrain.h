// Meshes that several tests stand on.
#pragma once

#include <cmath>
#include <vector>

#include "compat/physics_effects.h"

namespace compat_tests {

using namespace sce::PhysicsEffects;

// A hilly square of n x n cells of one metre: 2 n n triangles.
struct Terrain {
  std::vector<PfxFloat> verts;
  std::vector<PfxUInt32> indices, data;
  static PfxFloat height(PfxFloat x, PfxFloat z) { return 0.1f * std::abs(std::fmod(x * 0.3f + z * 0.2f, 2.0f) - 1.0f); }
  explicit Terrain(PfxUInt32 n) {
    for (PfxUInt32 z = 0; z <= n; ++z)
      for (PfxUInt32 x = 0; x <= n; ++x)
        for (const PfxFloat c : {PfxFloat(x), height(PfxFloat(x), PfxFloat(z)), PfxFloat(z)}) verts.push_back(c);
    for (PfxUInt32 z = 0; z < n; ++z)
      for (PfxUInt32 x = 0; x < n; ++x) {
        const PfxUInt32 a = z * (n + 1) + x, c = a + n + 1;
        for (const PfxUInt32 i : {a, c, a + 1, a + 1, c, c + 1}) indices.push_back(i);
        data.push_back(2 * (z * n + x)), data.push_back(2 * (z * n + x) + 1);
      }
  }
  PfxCreateLargeTriMeshParam param(PfxUInt32 flag) const {
    PfxCreateLargeTriMeshParam p;
    p.flag = flag | SCE_PFX_MESH_FLAG_32BIT_INDEX;
    p.verts = verts.data(), p.numVerts = static_cast<PfxUInt32>(verts.size() / 3);
    p.triangles = indices.data(), p.numTriangles = static_cast<PfxUInt32>(indices.size() / 3);
    p.triangleStrideBytes = 3 * sizeof(PfxUInt32);
    p.userData = data.data();
    return p;
  }
};

// Two triangles at height 0 over 0 .. length along x and -half_width .. half_width along z.
inline PfxInt32 createRectangle(PfxLargeTriMesh& mesh, PfxFloat length, PfxFloat half_width) {
  const PfxFloat verts[] = {0, 0, -half_width, length, 0, -half_width, 0, 0, half_width, length, 0, half_width};
  const PfxUInt16 triangles[] = {0, 2, 1, 1, 2, 3};
  PfxCreateLargeTriMeshParam param;
  param.verts = verts, param.numVerts = 4, param.triangles = triangles, param.numTriangles = 2;
  return pfxCreateLargeTriMesh(mesh, param);
}

}  // namespace compat_tests
