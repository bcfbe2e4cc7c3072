// What islands and colours need to know of a constraint: which two bodies it links.
#pragma once

#include <cstdint>

namespace pfx {

struct Link {
  uint32_t body_a = 0;
  uint32_t body_b = 0;
};

}  // namespace pfx
