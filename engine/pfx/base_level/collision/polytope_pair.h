// Two polytopes: boxes, convex meshes, or anything else that can be seen as one.
#pragma once

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/collision/pair_table.h"

namespace pfx {

struct PolytopePair {
  const Polytope& a;
  const ConvexCore& core_a;  // support mapping of a
  const Polytope& b;
  const ConvexCore& core_b;
};

void collidePolytopes(const PolytopePair& polytopes, const LocalPair& pair, LocalResult& result);

}  // namespace pfx
