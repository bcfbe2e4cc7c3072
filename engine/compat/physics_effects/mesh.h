// Convex and large triangle meshes, and how they are made.
#pragma once

#include "rigid_body.h"

// Of vertices and triangles that go in.
#define SCE_PFX_MESH_FLAG_NORMAL_FLIP 0x01u         // the other winding is the front
#define SCE_PFX_MESH_FLAG_16BIT_INDEX 0x02u         // (default)
#define SCE_PFX_MESH_FLAG_32BIT_INDEX 0x04u
#define SCE_PFX_MESH_FLAG_AUTO_ELIMINATION 0x08u    // triangles without area are dropped, always
#define SCE_PFX_MESH_FLAG_AUTO_THICKNESS 0x10u      // triangles are defaultThickness thick
// Of a large mesh that comes out.
#define SCE_PFX_MESH_FLAG_USE_BVH 0x20u
#define SCE_PFX_MESH_FLAG_USE_QUANTIZED 0x40u
#define SCE_PFX_MESH_FLAG_HIGH_QUALITY 0x80u

// How a large mesh is stored: floats or 16-bit integers, islands in a list or in a hierarchy.
#define SCE_PFX_LARGE_MESH_TYPE_EXPANDED_ARRAY 0
#define SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_ARRAY 1
#define SCE_PFX_LARGE_MESH_TYPE_EXPANDED_BVH 2
#define SCE_PFX_LARGE_MESH_TYPE_QUANTIZED_BVH 3

namespace sce {
namespace PhysicsEffects {

// The engine's own meshes, which the records below refer to.
struct PfxNativeConvexMesh;
struct PfxNativeLargeMesh;

// A convex mesh that was made; the arrays are its own.
struct PfxConvexMesh {
  // Vertices and triangles as they were given, and the engine's own mesh.
  PfxUInt16 m_numVerts = 0;
  PfxUInt16 m_numIndices = 0;
  PfxFloat* m_verts = nullptr;      // (numVerts x 3) m
  PfxUInt16* m_indices = nullptr;   // (numIndices)
  PfxVector3 m_half = PfxVector3(0.0f);  // m, bounds around the origin
  PfxNativeConvexMesh* m_native = nullptr;
};

// A run of at most 64 neighbouring triangles of a large mesh.
struct PfxTriMesh {
  // Its triangles, as a run of the triangles of the mesh, and their bounds, m.
  PfxUInt8 m_numFacets = 0;
  PfxUInt32 m_firstFacet = 0;
  PfxVector3 m_center = PfxVector3(0.0f);  // m, of its bounds
  PfxVector3 m_half = PfxVector3(0.0f);
};

// A large mesh that was made; the arrays are its own.
struct PfxLargeTriMesh {
  // How it is stored (SCE_PFX_LARGE_MESH_TYPE_...), its islands and triangles.
  PfxUInt8 m_type = SCE_PFX_LARGE_MESH_TYPE_EXPANDED_ARRAY;
  PfxUInt16 m_numIslands = 0;
  PfxUInt16 m_maxIslands = 0;
  PfxTriMesh* m_islands = nullptr;
  PfxUInt32 m_numFacets = 0;
  PfxVector3 m_half = PfxVector3(0.0f);  // m, bounds around the origin
  PfxNativeLargeMesh* m_native = nullptr;
};

// What a convex mesh is made of.
struct PfxCreateConvexMeshParam {
  // Flags, vertices (x, y, z in m at the start of each record) and triangles (three indices at the start of each record); they are
  // copied.
  PfxUInt32 flag = 0;
  const PfxFloat* verts = nullptr;
  PfxUInt32 numVerts = 0;
  PfxUInt32 vertexStrideBytes = sizeof(PfxFloat) * 3;
  const void* triangles = nullptr;
  PfxUInt32 numTriangles = 0;
  PfxUInt32 triangleStrideBytes = sizeof(PfxUInt16) * 3;
};

// What a large mesh is made of.
struct PfxCreateLargeTriMeshParam {
  // Flags, vertices (x, y, z in m at the start of each record) and triangles (three indices at the start of each record); they are
  // copied.
  PfxUInt32 flag = 0;
  const PfxFloat* verts = nullptr;
  PfxUInt32 numVerts = 0;
  PfxUInt32 vertexStrideBytes = sizeof(PfxFloat) * 3;
  const void* triangles = nullptr;
  PfxUInt32 numTriangles = 0;
  PfxUInt32 triangleStrideBytes = sizeof(PfxUInt16) * 3;
  const void* userData = nullptr;  // one 32-bit number for each triangle, or NULL
  PfxUInt32 userDataStrideBytes = sizeof(PfxUInt32);
  PfxUInt32 numFacetsLimit = SCE_PFX_MAX_ISLAND_FACETS;  // 1 .. 64; the engine divides by its own rule
  PfxFloat islandsRatio = 0.2f;                          // accepted; the engine divides by its own rule
  PfxFloat defaultThickness = 0.025f;                    // m, used with SCE_PFX_MESH_FLAG_AUTO_THICKNESS
};

// Islands of both ways to store.
typedef PfxTriMesh PfxExpandedTriMesh;
typedef PfxTriMesh PfxQuantizedTriMesh;

// Functions through which the memory of meshes goes; NULL for all: malloc and free. To be set while no mesh exists.
typedef void* (*PfxUtilityAllocFunc)(size_t align, size_t size);
typedef void* (*PfxUtilityReallocFunc)(void* ptr, size_t align, size_t size);
typedef void (*PfxUtilityFreeFunc)(void* ptr);
void pfxSetUtilityAllocator(PfxUtilityAllocFunc allocFunc, PfxUtilityReallocFunc reallocFunc, PfxUtilityFreeFunc freeFunc);
// Memory from them, aligned to at least 16 bytes; NULL when there is none.
void* pfxUtilAlloc(size_t align, size_t size);
void* pfxUtilRealloc(void* ptr, size_t align, size_t size);
void pfxUtilFree(void* ptr);
#define SCE_PFX_UTIL_ALLOC(align, size) ::sce::PhysicsEffects::pfxUtilAlloc(align, size)
#define SCE_PFX_UTIL_REALLOC(ptr, align, size) ::sce::PhysicsEffects::pfxUtilRealloc(ptr, align, size)
#define SCE_PFX_UTIL_FREE(ptr) ::sce::PhysicsEffects::pfxUtilFree(ptr)

// Makes a convex mesh of up to 64 triangles. SCE_PFX_ERR_INVALID_VALUE: NULL, an index out of range, a value that is not
// finite, concave or flat input; SCE_PFX_ERR_OUT_OF_RANGE_TRIANGLES: too many triangles; SCE_PFX_ERR_OUT_OF_BUFFER: no memory.
// The mesh is empty then.
PfxInt32 pfxCreateConvexMesh(PfxConvexMesh& mesh, const PfxCreateConvexMeshParam& param);
void pfxReleaseConvexMesh(PfxConvexMesh& mesh);

// Makes a mesh of up to 512 islands of 64 triangles. Errors as above; SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS: too many islands.
PfxInt32 pfxCreateLargeTriMesh(PfxLargeTriMesh& mesh, const PfxCreateLargeTriMeshParam& param);
void pfxReleaseLargeTriMesh(PfxLargeTriMesh& mesh);

}  // namespace PhysicsEffects
}  // namespace sce
