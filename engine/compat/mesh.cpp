#include "compat/mesh.h"

#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "compat/native.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace sce::PhysicsEffects {
namespace {

void* standardAlloc(size_t align, size_t size) { return std::aligned_alloc(align, (size + align - 1) / align * align); }

struct Allocator {
  PfxUtilityAllocFunc alloc = standardAlloc;
  PfxUtilityFreeFunc free = std::free;
};
Allocator allocator;

template <class T>
T* make(size_t count) {
  return static_cast<T*>(allocator.alloc(alignof(T) < 16 ? 16 : alignof(T), count * sizeof(T)));
}
void release(void* memory) {
  if (memory != nullptr) allocator.free(memory);
}
template <class T>
void destroy(T* object) {
  if (object == nullptr) return;
  object->~T();
  allocator.free(object);
}

struct Input {
  PfxInt32 error = SCE_PFX_OK;
  std::vector<pfx::Vec3> vertices;
  std::vector<uint32_t> indices;
};

template <class Param>
PfxInt32 check(const Param& p) {
  const bool wide = p.flag & SCE_PFX_MESH_FLAG_32BIT_INDEX;
  if (p.verts == nullptr || p.triangles == nullptr || p.numVerts == 0 || p.numTriangles == 0) return SCE_PFX_ERR_INVALID_VALUE;
  if (p.vertexStrideBytes < 3 * sizeof(PfxFloat)) return SCE_PFX_ERR_INVALID_VALUE;
  return p.triangleStrideBytes < 3 * (wide ? 4u : 2u) ? SCE_PFX_ERR_INVALID_VALUE : SCE_PFX_OK;
}

// Vertices and triangles out of records of any stride.
template <class Param>
Input read(const Param& p) {
  Input in;
  const auto* vertex = reinterpret_cast<const char*>(p.verts);
  for (PfxUInt32 i = 0; i < p.numVerts; ++i, vertex += p.vertexStrideBytes) {
    PfxFloat v[3];
    std::memcpy(v, vertex, sizeof v);
    in.vertices.push_back({v[0], v[1], v[2]});
  }
  const auto* triangle = static_cast<const char*>(p.triangles);
  for (PfxUInt32 i = 0; i < p.numTriangles; ++i, triangle += p.triangleStrideBytes) {
    uint32_t k[3];
    if (p.flag & SCE_PFX_MESH_FLAG_32BIT_INDEX) {
      std::memcpy(k, triangle, sizeof k);
    } else {
      uint16_t narrow[3];
      std::memcpy(narrow, triangle, sizeof narrow);
      for (int j = 0; j < 3; ++j) k[j] = narrow[j];
    }
    if (p.flag & SCE_PFX_MESH_FLAG_NORMAL_FLIP) std::swap(k[1], k[2]);
    for (const uint32_t index : k) {
      if (index >= p.numVerts) in.error = SCE_PFX_ERR_INVALID_VALUE;
      in.indices.push_back(index);
    }
  }
  return in;
}

std::vector<uint32_t> readUserData(const PfxCreateLargeTriMeshParam& p) {
  std::vector<uint32_t> data(p.userData != nullptr ? p.numTriangles : 0);
  for (size_t i = 0; i < data.size(); ++i)
    std::memcpy(&data[i], static_cast<const char*>(p.userData) + i * p.userDataStrideBytes, sizeof(uint32_t));
  return data;
}

PfxVector3 halfAroundOrigin(const pfx::Aabb& box) { return compat(box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs())); }

}  // namespace

void pfxSetUtilityAllocator(PfxUtilityAllocFunc allocFunc, PfxUtilityReallocFunc, PfxUtilityFreeFunc freeFunc) {
  allocator = allocFunc != nullptr && freeFunc != nullptr ? Allocator{allocFunc, freeFunc} : Allocator{};
}

PfxInt32 pfxCreateConvexMesh(PfxConvexMesh& mesh, const PfxCreateConvexMeshParam& param) {
  mesh = {};
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  if (param.numTriangles > SCE_PFX_MAX_CONVEX_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE;
  const Input in = read(param);
  if (in.error != SCE_PFX_OK) return in.error;
  pfx::ConvexMesh built;
  if (const pfx::Error error = pfx::checkConvexMesh(in.vertices, in.indices, built); error != pfx::Error::Ok) return errorCode(error);

  void* place = make<pfx::ConvexMesh>(1);
  auto* verts = make<PfxFloat>(3 * in.vertices.size());
  auto* indices = make<PfxUInt16>(in.indices.size());
  if (place == nullptr || verts == nullptr || indices == nullptr) {
    release(place), release(verts), release(indices);
    return SCE_PFX_ERR_OUT_OF_BUFFER;
  }
  mesh.m_half = halfAroundOrigin(built.bounds);
  mesh.m_native = new (place) pfx::ConvexMesh(std::move(built));
  mesh.m_verts = verts, mesh.m_indices = indices;
  mesh.m_numVerts = static_cast<PfxUInt16>(in.vertices.size());
  mesh.m_numIndices = static_cast<PfxUInt16>(in.indices.size());
  for (size_t i = 0; i < in.vertices.size(); ++i) pfxStoreVector3(compat(in.vertices[i]), verts + 3 * i);
  for (size_t i = 0; i < in.indices.size(); ++i) indices[i] = static_cast<PfxUInt16>(in.indices[i]);
  return SCE_PFX_OK;
}

void pfxReleaseConvexMesh(PfxConvexMesh& mesh) {
  destroy(mesh.m_native);
  release(mesh.m_verts), release(mesh.m_indices);
  mesh = {};
}

PfxInt32 pfxCreateLargeTriMesh(PfxLargeTriMesh& mesh, const PfxCreateLargeTriMeshParam& param) {
  mesh = {};
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  if (param.numTriangles > SCE_PFX_MAX_LARGETRIMESH_ISLANDS * SCE_PFX_MAX_ISLAND_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS;
  const Input in = read(param);
  if (in.error != SCE_PFX_OK) return in.error;
  const std::vector<uint32_t> user_data = readUserData(param);
  const uint8_t type = static_cast<uint8_t>((param.flag & SCE_PFX_MESH_FLAG_USE_QUANTIZED ? 1 : 0) +
                                            (param.flag & SCE_PFX_MESH_FLAG_USE_BVH ? 2 : 0));
  pfx::LargeMeshOptions options;
  options.type = static_cast<pfx::LargeMeshType>(type);
  options.high_quality = param.flag & SCE_PFX_MESH_FLAG_HIGH_QUALITY;
  options.thickness = param.defaultThickness;
  options.user_data = user_data;
  pfx::LargeMeshResult built = pfx::buildLargeMesh(in.vertices, in.indices, options);
  if (built.error != pfx::Error::Ok) return errorCode(built.error);
  const size_t num_islands = built.mesh.islands.size();
  if (num_islands > SCE_PFX_MAX_LARGETRIMESH_ISLANDS) return SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS;

  void* place = make<pfx::LargeMesh>(1);
  auto* islands = make<PfxTriMesh>(num_islands);
  if (place == nullptr || islands == nullptr) {
    release(place), release(islands);
    return SCE_PFX_ERR_OUT_OF_BUFFER;
  }
  mesh.m_type = type;
  mesh.m_numFacets = built.mesh.numFacets();
  mesh.m_half = halfAroundOrigin(built.mesh.bounds);
  mesh.m_numIslands = mesh.m_maxIslands = static_cast<PfxUInt16>(num_islands);
  mesh.m_islands = islands;
  mesh.m_native = new (place) pfx::LargeMesh(std::move(built.mesh));
  for (size_t i = 0; i < num_islands; ++i) {
    const pfx::MeshIsland& island = mesh.m_native->islands[i];
    islands[i] = {static_cast<PfxUInt8>(island.num_facets), island.first_facet, compat(island.bounds.center()),
                  compat(island.bounds.halfExtent())};
  }
  return SCE_PFX_OK;
}

void pfxReleaseLargeTriMesh(PfxLargeTriMesh& mesh) {
  destroy(mesh.m_native);
  release(mesh.m_islands);
  mesh = {};
}

}  // namespace sce::PhysicsEffects
