// One number that says whether two worlds are in the same state, to the last bit.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/rigid_body/rigid_state.h"

namespace pfx {

// Hash of position, orientation, linear and angular velocity of all bodies, in order, by their bits: -0 and
// +0 differ, and so do two NaNs. The same on all little-endian machines. Algorithm: XXH3, 64 bit.
uint64_t stateHash(std::span<const RigidState> states);

}  // namespace pfx
