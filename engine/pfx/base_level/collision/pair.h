// Two bodies whose bounding volumes meet, or that a joint links.
#pragma once

#include <cstdint>

namespace pfx {

inline constexpr uint32_t kNoContact = 0xffffffffu;

// 16 bytes, sorted by key. body_a < body_b always holds.
struct Pair {
  uint32_t body_a = 0;
  uint32_t body_b = 0;
  uint32_t contact_id = kNoContact;  // or joint index
  uint32_t flags = 0;                // reserved for the stage that owns the pair

  uint64_t key() const { return uint64_t(body_a) << 32 | body_b; }
};
static_assert(sizeof(Pair) == 16);

}  // namespace pfx
