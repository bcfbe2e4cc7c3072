// Basic types, error codes and limits of the overview's API.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "vectormath.h"

// Return values: SCE_PFX_OK, or a negative number that names the error.
#define SCE_PFX_OK 0
#define SCE_PFX_ERR_INVALID_VALUE ((int)0x80880000)
#define SCE_PFX_ERR_INVALID_ALIGN ((int)0x80880001)
#define SCE_PFX_ERR_OUT_OF_BUFFER ((int)0x80880002)
#define SCE_PFX_ERR_OUT_OF_MAX_PAIRS ((int)0x80880003)
#define SCE_PFX_ERR_OUT_OF_RANGE ((int)0x80880004)
#define SCE_PFX_ERR_OUT_OF_RANGE_VERTS SCE_PFX_ERR_OUT_OF_RANGE
#define SCE_PFX_ERR_OUT_OF_RANGE_TRIANGLES ((int)0x80880005)
#define SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS ((int)0x80880006)
#define SCE_PFX_ERR_OUT_OF_WORLD ((int)0x80880007)
#define SCE_PFX_ERR_INVALID_FLAG ((int)0x80880008)
// Of files.
#define SCE_PFX_ERR_SERIALIZE_LOADING_FAILED ((int)0x80880010)  // the file cannot be read, or its data have no room
#define SCE_PFX_ERR_SERIALIZE_SAVING_FAILED ((int)0x80880011)   // the file cannot be written
#define SCE_PFX_ERR_SERIALIZE_INVALID_DATA ((int)0x80880012)    // a value that is not allowed where it stands
#define SCE_PFX_ERR_SERIALIZE_INVALID_PARENTHESIS ((int)0x80880013)
#define SCE_PFX_ERR_SERIALIZE_INVALID_FILE ((int)0x80880014)     // not a file of this kind
#define SCE_PFX_ERR_SERIALIZE_INVALID_VERSION ((int)0x80880015)
#define SCE_PFX_ERR_SERIALIZE_INVALID_TAG ((int)0x80880016)      // another tag than expected
#define SCE_PFX_ERR_SERIALIZE_INVALID_FORM ((int)0x80880017)     // not a number
#define SCE_PFX_ERR_SERIALIZE_INVALID_COUNT ((int)0x80880018)    // more or fewer items than announced
// The same without the middle word.
#define SCE_PFX_ERR_FAILED_LOADING SCE_PFX_ERR_SERIALIZE_LOADING_FAILED
#define SCE_PFX_ERR_FAILED_SAVING SCE_PFX_ERR_SERIALIZE_SAVING_FAILED
#define SCE_PFX_ERR_INVALID_DATA SCE_PFX_ERR_SERIALIZE_INVALID_DATA
#define SCE_PFX_ERR_BAD_PARENTHESIS SCE_PFX_ERR_SERIALIZE_INVALID_PARENTHESIS
#define SCE_PFX_ERR_INVALID_FILE SCE_PFX_ERR_SERIALIZE_INVALID_FILE
#define SCE_PFX_ERR_INVALID_VERSION SCE_PFX_ERR_SERIALIZE_INVALID_VERSION
#define SCE_PFX_ERR_INVALID_TAG SCE_PFX_ERR_SERIALIZE_INVALID_TAG
#define SCE_PFX_ERR_INVALID_FORM SCE_PFX_ERR_SERIALIZE_INVALID_FORM
#define SCE_PFX_ERR_INVALID_COUNT SCE_PFX_ERR_SERIALIZE_INVALID_COUNT

// Whether a return value is SCE_PFX_OK.
#define SCE_PFX_SUCCEEDED(code) ((code) == SCE_PFX_OK)
#define SCE_PFX_FAILED(code) ((code) != SCE_PFX_OK)

// Numbers, and arithmetic on numbers of any kind; arguments may be evaluated twice.
#define SCE_PFX_PI 3.14159265358979f
#define SCE_PFX_FLT_MAX 1e38f  // stands for infinity
#define SCE_PFX_MIN(a, b) ((a) < (b) ? (a) : (b))
#define SCE_PFX_MAX(a, b) ((a) > (b) ? (a) : (b))
#define SCE_PFX_CLAMP(v, lower, upper) SCE_PFX_MAX(lower, SCE_PFX_MIN(v, upper))
#define SCE_PFX_SQR(x) ((x) * (x))
#define SCE_PFX_SWAP(type, a, b) \
  do {                           \
    type swapped_ = a;           \
    a = b;                       \
    b = swapped_;                \
  } while (0)
// Of a type or variable, in front of a declaration, behind `static` or behind the name, where alignas may not stand.
#define SCE_PFX_ALIGNED(bytes) __attribute__((aligned(bytes)))
#define SCE_PFX_FORCE_INLINE inline
#define SCE_PFX_PTR_IS_ALIGNED16(ptr) (((::std::uintptr_t)(ptr) & 15) == 0)
#define SCE_PFX_PTR_IS_ALIGNED128(ptr) (((::std::uintptr_t)(ptr) & 127) == 0)
#define SCE_PFX_PRINTF(...) ::std::printf(__VA_ARGS__)
#define SCE_PFX_ASSERT(test) assert(test)
#define SCE_PFX_ASSERT_MSG(test, msg) assert((test) && (msg))
// Checked in every build.
#define SCE_PFX_ALWAYS_ASSERT(test) ((test) ? (void)0 : ::sce::PhysicsEffects::pfxAssertionFailed(#test, __FILE__, __LINE__))
#define SCE_PFX_ALWAYS_ASSERT_MSG(test, msg) ((test) ? (void)0 : ::sce::PhysicsEffects::pfxAssertionFailed(msg, __FILE__, __LINE__))
// Room for n items or bytes, rounded up to whole units of 16 or 128.
#define SCE_PFX_BYTES_ALIGN16(n) (((n) + 15) / 16 * 16)
#define SCE_PFX_BYTES_ALIGN128(n) (((n) + 127) / 128 * 128)
#define SCE_PFX_ALLOC_BYTES_ALIGN16(n) SCE_PFX_BYTES_ALIGN16(n)
#define SCE_PFX_ALLOC_BYTES_ALIGN128(n) SCE_PFX_BYTES_ALIGN128(n)

// Limits.
#define SCE_PFX_MAX_SHAPES 64
#define SCE_PFX_NUMFACETLIMIT 64
#define SCE_PFX_MAX_CONVEX_FACETS 64
#define SCE_PFX_MAX_ISLAND_FACETS 64
#define SCE_PFX_MAX_LARGETRIMESH_ISLANDS 512
#define SCE_PFX_NUMCONTACTS_PER_BODIES 4

namespace sce {
namespace PhysicsEffects {

// Numbers of the size in their name, and what holds a pointer.
typedef int8_t PfxInt8;
typedef uint8_t PfxUInt8;
typedef int16_t PfxInt16;
typedef uint16_t PfxUInt16;
typedef int32_t PfxInt32;
typedef uint32_t PfxUInt32;
typedef int64_t PfxInt64;
typedef uint64_t PfxUInt64;
typedef bool PfxBool;
typedef float PfxFloat;
typedef uintptr_t PfxUIntPtr;

// Says where on the standard error stream, and aborts.
inline void pfxAssertionFailed(const char* what, const char* file, int line) {
  ::std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, what);
  ::std::abort();
}

// The vector math types under the names of this API.
typedef sce::Vectormath::Scalar::Aos::Point3 PfxPoint3;
typedef sce::Vectormath::Scalar::Aos::Vector3 PfxVector3;
typedef sce::Vectormath::Scalar::Aos::Vector4 PfxVector4;
typedef sce::Vectormath::Scalar::Aos::Quat PfxQuat;
typedef sce::Vectormath::Scalar::Aos::Matrix3 PfxMatrix3;
typedef sce::Vectormath::Scalar::Aos::Matrix4 PfxMatrix4;
typedef sce::Vectormath::Scalar::Aos::Transform3 PfxTransform3;
typedef sce::Vectormath::Scalar::floatInVec PfxFloatInVec;
typedef sce::Vectormath::Scalar::boolInVec PfxBoolInVec;

// Between vectors and the packed floats of the records.
inline PfxVector3 pfxReadVector3(const PfxFloat* v) { return PfxVector3(v[0], v[1], v[2]); }
inline PfxPoint3 pfxReadPoint3(const PfxFloat* v) { return PfxPoint3(v[0], v[1], v[2]); }
inline PfxQuat pfxReadQuat(const PfxFloat* v) { return PfxQuat(v[0], v[1], v[2], v[3]); }
inline void pfxStoreVector3(const PfxVector3& v, PfxFloat* to) { to[0] = v[0], to[1] = v[1], to[2] = v[2]; }
inline void pfxStorePoint3(const PfxPoint3& v, PfxFloat* to) { to[0] = v[0], to[1] = v[1], to[2] = v[2]; }
inline void pfxStoreQuat(const PfxQuat& q, PfxFloat* to) { to[0] = q[0], to[1] = q[1], to[2] = q[2], to[3] = q[3]; }

}  // namespace PhysicsEffects
}  // namespace sce
