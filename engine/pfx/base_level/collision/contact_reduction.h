// The four-point rule: of many candidate contacts keep four, the deepest among them, that span the largest
// area.
#pragma once

#include <span>

#include "pfx/base_level/collision/local_manifold.h"

namespace pfx {

// Keeps at most four of `candidates` (any order, one normal) in `manifold`. The deepest point is always kept;
// depths that differ by less than a ten-thousandth of the patch count as equal, so that a resting body does
// not change its points from frame to frame. Among the rest the quadrilateral of largest area wins, and an
// earlier candidate wins a tie of 2 %.
void reduceContacts(std::span<const LocalContact> candidates, LocalManifold& manifold);

}  // namespace pfx
