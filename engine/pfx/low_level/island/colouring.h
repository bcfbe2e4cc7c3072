// Graph colouring: groups of constraints that share no dynamic body, so that a group can be solved in any
// order, many at a time.
//
// Greedy, in the order of the links: each takes the first colour that neither of its bodies has, found in a
// 64-bit mask per body. Links between two dynamic bodies take colours from the front, links with one dynamic
// body from the back: what holds against the fixed world is solved last and wins. A link for which no colour
// is free goes to the overflow list, which has to be solved one after the other.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/island/link.h"

namespace pfx {

inline constexpr int kMaxColours = 64;
inline constexpr int kMaxDynamicColours = 52;  // the rest is kept for links with one dynamic body

class Colouring {
 public:
  // Colours `links`. is_dynamic: by body, nonzero when the solver changes its velocity; a body index past its
  // end is not dynamic. A link without a dynamic body gets the last colour, as it can disturb nobody.
  // Allocates only to grow; the cost is that of the links.
  void build(std::span<const Link> links, std::span<const uint8_t> is_dynamic);

  // Colours that are in use, in the order in which to solve them.
  uint32_t size() const { return static_cast<uint32_t>(begin_.size()) - 1; }
  std::span<const uint32_t> links(uint32_t colour) const;  // indices into `links` of build, ascending
  std::span<const uint32_t> overflow() const;              // indices into `links` of build, ascending

 private:
  void choose(std::span<const Link> links, std::span<const uint8_t> is_dynamic);

  Vector<uint64_t> used_;         // by body, bit c: a link of colour c; all zero between builds
  Vector<uint8_t> colour_;        // by link
  Vector<uint32_t> order_;        // link indices by colour, the overflow at the end
  Vector<uint32_t> begin_ = {0};  // (colours in use + 1)
};

}  // namespace pfx
