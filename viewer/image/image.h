// A picture in memory: 8-bit RGBA, rows from top to bottom, no padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace viewer {

struct Image {
  int width = 0, height = 0;  // px
  std::vector<uint8_t> rgba;  // (height x width x 4), sRGB

  bool empty() const { return rgba.empty(); }
  size_t numPixels() const { return size_t(width) * size_t(height); }
  bool sameSize(const Image& b) const { return width == b.width && height == b.height; }
  bool operator==(const Image&) const = default;
};

// Names the size and every pixel: equal images have equal hashes on every machine. XXH3, 64 bit.
uint64_t imageHash(const Image& image);

}  // namespace viewer
