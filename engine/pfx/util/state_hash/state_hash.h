// One number for the state of all bodies, to tell whether two runs went the same way to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pfx/base_level/rigid_body/rigid_state.h"

namespace pfx {

// 64-bit hash of position, orientation and both velocities of every body, in order, bit by bit.
uint64_t hashStates(std::span<const RigidState> states);

// 64-bit hash of bytes (XXH64), the same on every platform. `seed`: hash of what comes before them.
uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed = 0);

}  // namespace pfx
