// A picture in memory: 8-bit RGBA, rows from top to bottom, no padding.
#pragma once

#include <cstdint>
#include <vector>

namespace viewer {

struct Image {
  int width = 0, height = 0;   // px
  std::vector<uint8_t> rgba;   // (height x width x 4), sRGB

  bool empty() const { return rgba.empty(); }
};

}  // namespace viewer
