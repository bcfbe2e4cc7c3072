// Manifolds of compounds: parts that touch along one normal share a manifold.
//
// The parts of a body move as one, so that the four points that hold it along a normal are enough, however
// many parts have points there. More of them would only share the load in a way that an iterative solver
// finds slowly.
#pragma once

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/memory/containers.h"

namespace pfx {

// Joins manifolds of one pair of bodies with the same normal (to a quarter of a degree) into one of four
// points, by the four-point rule. `candidates` is scratch.
void mergeManifolds(const Transform& b_in_a, Vector<LocalContact>& candidates,
                    Vector<ContactManifold>& manifolds);

}  // namespace pfx
