// Groups of constraints that share no particle, so that a group can be solved many at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pfx {

// Sorts `items` by colour and returns where each colour begins (colours + 1 entries). Greedy: each item takes the
// first colour that none of its particles has; the order within a colour is that of `items`, and colouring the result
// again changes nothing. particlesOf(item) is a range of indices below `num_particles`.
template <class Item, class ParticlesOf>
std::vector<uint32_t> sortByColour(std::vector<Item>& items, size_t num_particles, ParticlesOf&& particlesOf) {
  std::vector<uint32_t> colour(items.size()), order(items.size());
  std::vector<std::vector<uint32_t>> used(num_particles);  // colours of each particle's constraints
  uint32_t num_colours = 0;
  for (uint32_t i = 0; i < items.size(); ++i) {
    const auto isFree = [&](uint32_t c) {
      for (const uint32_t p : particlesOf(items[i]))
        if (std::find(used[p].begin(), used[p].end(), c) != used[p].end()) return false;
      return true;
    };
    while (!isFree(colour[i])) ++colour[i];
    for (const uint32_t p : particlesOf(items[i])) used[p].push_back(colour[i]);
    num_colours = std::max(num_colours, colour[i] + 1);
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t x, uint32_t y) { return colour[x] < colour[y]; });
  std::vector<Item> sorted;
  sorted.reserve(items.size());
  std::vector<uint32_t> begin(num_colours + 1, 0);
  for (const uint32_t i : order) {
    ++begin[colour[i] + 1];
    sorted.push_back(std::move(items[i]));
  }
  for (uint32_t c = 0; c < num_colours; ++c) begin[c + 1] += begin[c];
  items = std::move(sorted);
  return begin;
}

}  // namespace pfx
