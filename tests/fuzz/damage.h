// Files that were damaged on the way: cut off, or with single bits turned over.
#pragma once

#include <algorithm>
#include <random>
#include <string>

namespace fuzz {

inline constexpr int kDamagedFiles = 1000;

// The n-th damaged copy of `good`; every other one is cut off.
inline std::string damaged(const std::string& good, int n) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(n));
  const auto below = [&](size_t limit) { return static_cast<size_t>(random()) % limit; };
  std::string bad = good;
  if (n % 2 == 0) {
    bad.resize(below(good.size()));
    return bad;
  }
  const size_t flips = 1 + below(4);
  for (size_t i = 0; i < flips; ++i) {
    const size_t at = below(bad.size());
    const auto bit = static_cast<unsigned>(below(8));
    bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ (1u << bit));
  }
  return bad;
}

}  // namespace fuzz
