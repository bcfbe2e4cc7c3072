// How far apart two pictures are, in numbers that separate noise from defects.
//
// Means over the image hide a missing box; the largest 8x8 block shows it. The distance of two pixels is the
// largest difference of their four channels.
#pragma once

#include "viewer/image/image.h"

namespace viewer {

inline constexpr int kBlock = 8;          // px, side of a block
inline constexpr int kVisibleLevels = 3;  // differences above this many levels are counted

struct ImageDifference {
  int max_channel = 0;           // levels of 255, over all pixels and channels
  uint32_t pixels_over = 0;      // pixels further apart than kVisibleLevels
  float max_block = 0.0f;        // levels, largest mean distance of an 8x8 block
  int worst_x = 0, worst_y = 0;  // px, top left corner of that block

  bool equal() const { return max_channel == 0; }
};

// Throws std::invalid_argument when the sizes differ. About 1 ms at 640x360.
ImageDifference measureDifference(const Image& a, const Image& b);

// The distance of every pixel as a grey picture, amplified so that one level is visible and 32 are white.
Image differenceImage(const Image& a, const Image& b);

// Values of 0 .. 1 (height x width) on the map black - purple - red - orange - yellow - white.
Image heatImage(int width, int height, const std::vector<float>& values);

}  // namespace viewer
