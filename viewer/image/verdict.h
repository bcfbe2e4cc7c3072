// Whether a picture passes for its golden image.
//
// Two rules. On the rasteriser that drew the golden the picture must be the same up to rounding. On another
// one lines and edges differ by whole pixels, so that only what a person would see, in the worst block,
// decides.
#pragma once

#include <optional>
#include <string>

#include "viewer/image/flip.h"
#include "viewer/image/image.h"
#include "viewer/image/metric.h"

namespace viewer {

enum class Rasteriser { Same, Other };

// What still passes. The defaults separate the noise of one rasteriser family from a box that moved by 1 cm.
struct Limits {
  int max_channel = 8;          // levels
  double pixels_over = 0.0002;  // share of the pixels that may differ by more than kVisibleLevels
  float max_block = 1.0f;       // levels
  float other_max_block_flip = 0.12f;
  float other_mean_flip = 0.02f;
};

struct Verdict {
  bool pass = false;
  bool exact = false;  // every pixel is equal
  std::string why;     // one line, with the figure that decided
  ImageDifference difference;
  std::optional<FlipResult> flip;  // when it was computed
};

// FLIP is computed for Rasteriser::Other when a pixel differs. Images of different size fail.
Verdict judge(const Image& golden, const Image& actual, Rasteriser rasteriser, const Limits& limits = {});

}  // namespace viewer
