#include "compat/physics_effects/mesh.h"

#include <algorithm>
#include <cstdlib>
#include <memory_resource>
#include <new>
#include <span>
#include <vector>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace sce::PhysicsEffects {
namespace {

void* standardAlloc(size_t align, size_t size) { return std::aligned_alloc(align, (size + align - 1) / align * align); }

void* standardRealloc(void* old, size_t align, size_t size) {
  return align <= alignof(std::max_align_t) ? std::realloc(old, size) : nullptr;
}

struct Allocator {
  PfxUtilityAllocFunc alloc = standardAlloc;
  PfxUtilityReallocFunc realloc = standardRealloc;
  PfxUtilityFreeFunc free = std::free;
};
Allocator allocator;

constexpr size_t kLeastAlign = 16;

template <class T>
T* make(size_t count) {
  return static_cast<T*>(pfxUtilAlloc(alignof(T), count * sizeof(T)));
}
template <class T>
void destroy(T* object) {
  if (object == nullptr) return;
  object->~T();
  pfxUtilFree(object);
}

// What the arrays of a mesh are allocated from.
class UtilityMemory : public std::pmr::memory_resource {
  void* do_allocate(size_t bytes, size_t align) override {
    void* memory = pfxUtilAlloc(align, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  void do_deallocate(void* memory, size_t, size_t) override { pfxUtilFree(memory); }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};
UtilityMemory utility_memory;

// The mesh with its arrays in memory of the application's.
pfx::LargeMesh copyToUtilityMemory(const pfx::LargeMesh& m) {
  const auto copied = []<class T>(const pfx::MeshArray<T>& from) {
    return pfx::MeshArray<T>(from, &utility_memory);
  };
  return {.type = m.type,
          .bounds = m.bounds,
          .surface_bounds = m.surface_bounds,
          .max_thickness = m.max_thickness,
          .num_source_vertices = m.num_source_vertices,
          .islands = copied(m.islands),
          .neighbors = copied(m.neighbors),
          .source = copied(m.source),
          .user_data = copied(m.user_data),
          .vertices = copied(m.vertices),
          .triangles = copied(m.triangles),
          .facets = copied(m.facets),
          .nodes = copied(m.nodes),
          .grid_scale = m.grid_scale,
          .quantized_vertices = copied(m.quantized_vertices),
          .vertex_source = copied(m.vertex_source),
          .vertex_blocks = copied(m.vertex_blocks),
          .quantized_facets = copied(m.quantized_facets),
          .quantized_nodes = copied(m.quantized_nodes)};
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

void pfxSetUtilityAllocator(PfxUtilityAllocFunc allocFunc, PfxUtilityReallocFunc reallocFunc, PfxUtilityFreeFunc freeFunc) {
  allocator = allocFunc != nullptr && freeFunc != nullptr ? Allocator{allocFunc, reallocFunc, freeFunc} : Allocator{};
}

void* pfxUtilAlloc(size_t align, size_t size) { return allocator.alloc(std::max(align, kLeastAlign), std::max<size_t>(size, 1)); }
void* pfxUtilRealloc(void* ptr, size_t align, size_t size) {
  return allocator.realloc == nullptr ? nullptr : allocator.realloc(ptr, std::max(align, kLeastAlign), std::max<size_t>(size, 1));
}
void pfxUtilFree(void* ptr) {
  if (ptr != nullptr) allocator.free(ptr);
}

PfxInt32 pfxCreateConvexMesh(PfxConvexMesh& mesh, const PfxCreateConvexMeshParam& param) {
  mesh = {};
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  if (param.numTriangles > SCE_PFX_MAX_CONVEX_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE_TRIANGLES;
  const Input in = read(param);
  if (in.error != SCE_PFX_OK) return in.error;
  pfx::ConvexMesh built;
  const pfx::Error error = pfx::checkConvexMesh(in.vertices, in.indices, built);
  return error == pfx::Error::Ok ? adoptConvexMesh(mesh, std::move(built), in.vertices, in.indices) : errorCode(error);
}

PfxInt32 adoptConvexMesh(PfxConvexMesh& mesh, pfx::ConvexMesh&& built, std::span<const pfx::Vec3> vertices,
                         std::span<const uint32_t> indices) {
  mesh = {};
  auto* verts = make<PfxFloat>(3 * vertices.size());
  auto* out = make<PfxUInt16>(indices.size());
  void* place = make<PfxNativeConvexMesh>(1);
  if (place == nullptr || verts == nullptr || out == nullptr) {
    pfxUtilFree(place), pfxUtilFree(verts), pfxUtilFree(out);
    return SCE_PFX_ERR_OUT_OF_BUFFER;
  }
  for (size_t i = 0; i < vertices.size(); ++i) pfxStoreVector3(compat(vertices[i]), verts + 3 * i);
  std::copy(indices.begin(), indices.end(), out);
  mesh.m_verts = verts, mesh.m_indices = out;
  mesh.m_numVerts = static_cast<PfxUInt16>(vertices.size());
  mesh.m_numIndices = static_cast<PfxUInt16>(indices.size());
  mesh.m_half = halfAroundOrigin(built.bounds);
  mesh.m_native = new (place) PfxNativeConvexMesh{std::move(built)};
  return SCE_PFX_OK;
}

void pfxReleaseConvexMesh(PfxConvexMesh& mesh) {
  destroy(mesh.m_native);
  pfxUtilFree(mesh.m_verts), pfxUtilFree(mesh.m_indices);
  mesh = {};
}

PfxInt32 pfxCreateLargeTriMesh(PfxLargeTriMesh& mesh, const PfxCreateLargeTriMeshParam& param) {
  mesh = {};
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  if (param.numFacetsLimit == 0 || param.numFacetsLimit > SCE_PFX_MAX_ISLAND_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE;
  if (param.numTriangles > SCE_PFX_MAX_LARGETRIMESH_ISLANDS * SCE_PFX_MAX_ISLAND_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS;
  const Input in = read(param);
  if (in.error != SCE_PFX_OK) return in.error;
  const std::vector<uint32_t> user_data = readUserData(param);
  pfx::LargeMeshOptions options;
  options.type = static_cast<pfx::LargeMeshType>((param.flag & SCE_PFX_MESH_FLAG_USE_QUANTIZED ? 1 : 0) +
                                                 (param.flag & SCE_PFX_MESH_FLAG_USE_BVH ? 2 : 0));
  options.high_quality = param.flag & SCE_PFX_MESH_FLAG_HIGH_QUALITY;
  options.thickness = param.defaultThickness;
  options.user_data = user_data;
  const pfx::LargeMeshResult built = pfx::buildLargeMesh(in.vertices, in.indices, options);
  return built.error == pfx::Error::Ok ? adoptLargeMesh(mesh, built.mesh) : errorCode(built.error);
}

PfxInt32 adoptLargeMesh(PfxLargeTriMesh& mesh, const pfx::LargeMesh& built) try {
  mesh = {};
  const size_t num_islands = built.islands.size();
  if (num_islands > SCE_PFX_MAX_LARGETRIMESH_ISLANDS) return SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS;
  pfx::LargeMesh copy = copyToUtilityMemory(built);
  void* place = make<PfxNativeLargeMesh>(1);
  auto* islands = make<PfxTriMesh>(num_islands);
  if (place == nullptr || islands == nullptr) {
    pfxUtilFree(place), pfxUtilFree(islands);
    return SCE_PFX_ERR_OUT_OF_BUFFER;
  }
  for (size_t i = 0; i < num_islands; ++i) {
    const pfx::MeshIsland& island = built.islands[i];
    new (&islands[i]) PfxTriMesh{static_cast<PfxUInt8>(island.num_facets), island.first_facet,
                                 compat(island.bounds.center()), compat(island.bounds.halfExtent())};
  }
  mesh.m_type = static_cast<PfxUInt8>(built.type);
  mesh.m_numFacets = built.numFacets();
  mesh.m_half = halfAroundOrigin(built.bounds);
  mesh.m_numIslands = mesh.m_maxIslands = static_cast<PfxUInt16>(num_islands);
  mesh.m_islands = islands;
  mesh.m_native = new (place) PfxNativeLargeMesh{std::move(copy)};
  reserveMeshContacts();
  return SCE_PFX_OK;
} catch (const std::bad_alloc&) {
  return SCE_PFX_ERR_OUT_OF_BUFFER;
}

void pfxReleaseLargeTriMesh(PfxLargeTriMesh& mesh) {
  destroy(mesh.m_native);
  pfxUtilFree(mesh.m_islands);
  mesh = {};
}

}  // namespace sce::PhysicsEffects
