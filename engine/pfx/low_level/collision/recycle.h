// Keeping the manifolds of a pair that has hardly moved.
#pragma once

#include <span>

#include "pfx/low_level/collision/contact_store.h"

namespace pfx {

// Radii (m) of balls around the origins of the two bodies that hold their shapes.
struct PairRadii {
  float a, b;
};

// True when no point that both bodies can reach has moved by more than `tolerance` (m) with B in the frame of
// A since the manifolds were found.
bool hardlyMoved(const Contact& contact, const Transform& b_in_a, const PairRadii& radii, float tolerance);

// Brings normals and distances up to date with the poses.
void measureAgain(std::span<ContactManifold> manifolds, const Transform& pose_a, const Transform& pose_b);

}  // namespace pfx
