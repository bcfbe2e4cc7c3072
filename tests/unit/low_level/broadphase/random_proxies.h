// Random proxies and the pairs that brute force finds among them; what every broad phase is checked against.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "pfx/base_level/collision/pair.h"
#include "pfx/low_level/broadphase/proxy.h"

namespace pfx {

inline Vec3 randomVector(std::mt19937& random, float low, float high) {
  std::uniform_real_distribution<float> uniform(low, high);
  const float x = uniform(random);
  const float y = uniform(random);
  const float z = uniform(random);
  return {x, y, z};
}

// All motion types, some filters, sizes over two orders of magnitude.
inline std::vector<BroadphaseProxy> randomProxies(uint32_t count, float extent, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<BroadphaseProxy> proxies(count);
  for (uint32_t i = 0; i < count; ++i) {
    BroadphaseProxy& p = proxies[i];
    const Vec3 center = randomVector(random, -extent, extent);
    const Vec3 half = randomVector(random, 0.05f, 1.0f) * (random() % 20 == 0 ? 8.0f : 1.0f);
    p.bounds = {center - half, center + half};
    p.body = i;
    p.motion_type =
        random() % 3 == 0 ? static_cast<MotionType>(random() % kNumMotionTypes) : MotionType::Active;
    if (random() % 4 == 0) p.filter_self = 1u << random() % 3;
    if (random() % 4 == 0) p.filter_target = 3u << random() % 2;
  }
  std::shuffle(proxies.begin(), proxies.end(), random);
  return proxies;
}

inline std::vector<Pair> bruteForcePairs(const std::vector<BroadphaseProxy>& proxies) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    for (std::size_t j = i + 1; j < proxies.size(); ++j) {
      if (!proxies[i].bounds.overlaps(proxies[j].bounds) || !mayPair(proxies[i], proxies[j])) continue;
      const uint32_t a = proxies[i].body, b = proxies[j].body;
      pairs.push_back({std::min(a, b), std::max(a, b), kNoContact, 0});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.key() < b.key(); });
  return pairs;
}

inline std::vector<uint64_t> keys(std::span<const Pair> pairs) {
  std::vector<uint64_t> out;
  for (const Pair& p : pairs) out.push_back(p.key());
  return out;
}

}  // namespace pfx
