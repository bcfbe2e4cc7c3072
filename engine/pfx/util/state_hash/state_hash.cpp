// Packs the floats that count, a block of bodies at a time, and hashes the blocks.
#include "pfx/util/state_hash/state_hash.h"

#include <algorithm>
#include <array>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pfx {

namespace {

using PackedState = std::array<float, 13>;

PackedState pack(const RigidState& s) {
  const Vec3 &p = s.position, &v = s.linear_velocity, &w = s.angular_velocity;
  const Quat& q = s.orientation;
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}

}  // namespace

uint64_t stateHash(std::span<const RigidState> states) {
  XXH3_state_t hash;
  XXH3_64bits_reset(&hash);
  std::array<PackedState, 64> block;
  for (std::size_t begin = 0; begin < states.size(); begin += block.size()) {
    const std::size_t count = std::min(block.size(), states.size() - begin);
    std::transform(states.begin() + begin, states.begin() + begin + count, block.begin(), pack);
    XXH3_64bits_update(&hash, block.data(), count * sizeof(PackedState));
  }
  return XXH3_64bits_digest(&hash);
}

}  // namespace pfx
