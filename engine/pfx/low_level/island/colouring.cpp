// Greedy colouring with one mask per body, then a counting sort by colour.
#include "pfx/low_level/island/colouring.h"

#include <array>
#include <bit>

namespace pfx {

namespace {

constexpr uint8_t kOverflow = kMaxColours;
constexpr uint64_t kDynamicColours = (uint64_t{1} << kMaxDynamicColours) - 1;

}  // namespace

void Colouring::choose(std::span<const Link> links, std::span<const uint8_t> is_dynamic) {
  const auto dynamic = [&](uint32_t body) { return body < is_dynamic.size() && is_dynamic[body] != 0; };
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto [a, b] = links[i];
    const bool dynamic_a = dynamic(a), dynamic_b = dynamic(b);
    const uint64_t taken = (dynamic_a ? used_[a] : 0) | (dynamic_b ? used_[b] : 0);
    const uint64_t free = ~taken & (dynamic_a && dynamic_b ? kDynamicColours : ~uint64_t{0});
    if (free == 0) {
      colour_[i] = kOverflow;
      continue;
    }
    const int colour = dynamic_a && dynamic_b ? std::countr_zero(free) : 63 - std::countl_zero(free);
    colour_[i] = static_cast<uint8_t>(colour);
    if (dynamic_a) used_[a] |= uint64_t{1} << colour;
    if (dynamic_b) used_[b] |= uint64_t{1} << colour;
  }
  for (const auto& [a, b] : links) {
    if (a < used_.size()) used_[a] = 0;
    if (b < used_.size()) used_[b] = 0;
  }
}

void Colouring::build(std::span<const Link> links, std::span<const uint8_t> is_dynamic) {
  if (used_.size() < is_dynamic.size()) used_.resize(is_dynamic.size(), 0);
  colour_.resize(links.size());
  order_.resize(links.size());
  choose(links, is_dynamic);

  std::array<uint32_t, kMaxColours + 1> place{};
  for (uint8_t colour : colour_) ++place[colour];
  begin_.assign(1, 0);
  uint32_t sum = 0;
  for (std::size_t colour = 0; colour < place.size(); ++colour) {
    const uint32_t count = place[colour];
    place[colour] = sum;
    sum += count;
    if (count > 0 && colour != kOverflow) begin_.push_back(sum);
  }
  for (uint32_t i = 0; i < links.size(); ++i) order_[place[colour_[i]]++] = i;
}

std::span<const uint32_t> Colouring::links(uint32_t colour) const {
  return std::span(order_).subspan(begin_[colour], begin_[colour + 1] - begin_[colour]);
}

std::span<const uint32_t> Colouring::overflow() const { return std::span(order_).subspan(begin_.back()); }

}  // namespace pfx
