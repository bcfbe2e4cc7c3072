// The state hash: sees every bit that counts and nothing else.
#include "pfx/util/state_hash/state_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace pfx {
namespace {

std::vector<RigidState> someStates(std::size_t count) {
  std::vector<RigidState> states(count);
  for (std::size_t i = 0; i < count; ++i)
    states[i].position = Vec3(0.5f * static_cast<float>(i), 1.0f, -2.0f);
  return states;
}

TEST(StateHash, changesWithTheLastBitOfAnyComponentOfAnyBody) {
  for (std::size_t count : {1u, 63u, 64u, 65u, 200u}) {
    const auto states = someStates(count);
    std::set<uint64_t> hashes = {hashStates(states)};
    std::size_t changes = 0;
    for (std::size_t body : {std::size_t{0}, count / 2, count - 1}) {
      for (int component = 0; component < 13; ++component) {
        auto changed = states;
        RigidState& s = changed[body];
        float& x = component < 3    ? s.position[component]
                   : component < 7  ? s.orientation.coeffs()[component - 3]
                   : component < 10 ? s.linear_velocity[component - 7]
                                    : s.angular_velocity[component - 10];
        x = std::nextafter(x, 2e9f);
        hashes.insert(hashStates(changed));
        ++changes;
      }
    }
    const std::size_t distinct_bodies = count == 1 ? 1 : 3;
    EXPECT_EQ(hashes.size(), 1 + changes / 3 * distinct_bodies) << count;
  }
}

TEST(StateHash, doesNotSeeFlagsAndCounters) {
  auto states = someStates(10);
  const uint64_t before = hashStates(states);
  states[3].sleep_count = 7, states[3].asleep = true, states[4].filter_self = 1;
  EXPECT_EQ(hashStates(states), before);
}

TEST(StateHash, dependsOnTheOrderAndTheNumberOfBodies) {
  auto states = someStates(5);
  const uint64_t before = hashStates(states);
  EXPECT_NE(hashStates(std::span(states).first(4)), before);
  std::swap(states[0], states[1]);
  EXPECT_NE(hashStates(states), before);
}


}  // namespace
}  // namespace pfx
