// Names geometries by what they are, so that equal shapes are drawn as instances of one mesh.
#pragma once

#include <cstdint>

#include "pfx/base_level/shape/shape.h"

namespace pfx {

// Hash of the content: equal geometries have equal keys wherever they are stored, in every run. For meshes
// the cost is proportional to their size. Algorithm: XXH3, 64 bit.
uint64_t geometryKey(const Geometry& geometry);

// Cheap stand-in for the key within one run: for a mesh it names the object and not its content.
uint64_t geometryIdentity(const Geometry& geometry);

// True when both are of one type with the same sizes, or the same mesh object.
bool sameGeometry(const Geometry& a, const Geometry& b);

}  // namespace pfx
