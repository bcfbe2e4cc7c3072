// Capsule against any polytope (box, convex mesh, triangle).
#pragma once

#include "pfx/base_level/collision/contact_clipping.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/pair_table.h"

namespace pfx {

// `core` is the support mapping of the same polytope, which is the first shape of the pair.
void collidePolytopeCapsule(const Polytope& polytope, const ConvexCore& core, const Capsule& capsule,
                            const LocalPair& pair, LocalResult& result);

}  // namespace pfx
