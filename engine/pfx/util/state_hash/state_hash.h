// One number for the state of all bodies, to tell whether two runs went the same way to the last bit.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/rigid_body/rigid_state.h"

namespace pfx {

// 64-bit hash of position, orientation and both velocities of every body, in order, bit by bit.
uint64_t hashStates(std::span<const RigidState> states);

}  // namespace pfx
