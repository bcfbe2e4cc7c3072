#include "pfx/high_level/world/apart_pairs.h"

#include <algorithm>

#include "pfx/base_level/collision/pair.h"

namespace pfx {
namespace {

uint64_t keyOf(uint32_t a, uint32_t b) { return Pair{.body_a = std::min(a, b), .body_b = std::max(a, b)}.key(); }

}  // namespace

void ApartPairs::add(uint32_t body_a, uint32_t body_b) {
  const uint64_t key = keyOf(body_a, body_b);
  const auto at = std::lower_bound(keys_.begin(), keys_.end(), key);
  if (at == keys_.end() || *at != key) keys_.insert(at, key);
}

void ApartPairs::remove(uint32_t body_a, uint32_t body_b) {
  const auto [first, last] = std::equal_range(keys_.begin(), keys_.end(), keyOf(body_a, body_b));
  keys_.erase(first, last);
}

bool ApartPairs::contains(uint32_t body_a, uint32_t body_b) const {
  return std::binary_search(keys_.begin(), keys_.end(), keyOf(body_a, body_b));
}

void ApartPairs::forgetBody(uint32_t body) {
  std::erase_if(keys_, [&](uint64_t key) { return key >> 32 == body || (key & 0xffffffffu) == body; });
}

}  // namespace pfx
