#include "pfx/util/state_hash/state_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pfx {

uint64_t hashStates(std::span<const RigidState> states) {
  XXH64_hash_t hash = 0;
  for (const RigidState& s : states) {
    const auto& q = s.orientation.coeffs();
    const float values[13] = {s.position.x(),         s.position.y(),         s.position.z(),
                              q.x(),                  q.y(),                  q.z(),
                              q.w(),                  s.linear_velocity.x(),  s.linear_velocity.y(),
                              s.linear_velocity.z(),  s.angular_velocity.x(), s.angular_velocity.y(),
                              s.angular_velocity.z()};
    hash = XXH64(values, sizeof(values), hash);
  }
  return hash;
}

uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed) { return XXH64(bytes.data(), bytes.size(), seed); }

}  // namespace pfx
