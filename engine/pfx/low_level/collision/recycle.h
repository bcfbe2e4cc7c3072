// Keeping the manifolds of a pair that has hardly moved.
#pragma once

#include <span>

#include "pfx/low_level/collision/contact_store.h"

namespace pfx {

// True when no point of B, which lies within radius_b of its origin, has moved by more than `tolerance` (m) in the frame
// of A since the manifolds were found.
bool hardlyMoved(const Contact& contact, const Transform& b_in_a, float radius_b, float tolerance);

// Brings normals and distances up to date with the poses.
void measureAgain(std::span<ContactManifold> manifolds, const Transform& pose_a, const Transform& pose_b);

}  // namespace pfx
