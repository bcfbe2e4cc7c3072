// FLIP: how different two pictures look to a person who flips between them, 0 .. 1 a pixel.
//
// Costs about 100 times the plain metric, so that only reports and pictures of another rasteriser use it.
// Source: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. Fairchild, FLIP: A
// Difference Evaluator for Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; equations
// in flip.cpp.
#pragma once

#include "viewer/image/image.h"

namespace viewer {

struct FlipResult {
  std::vector<float> map;  // (height x width), 0 same .. 1 most different
  float mean = 0.0f;
  float max_block = 0.0f;  // largest mean of an 8x8 block
};

// Viewing conditions as in the paper: 0.7 m from a 0.7 m wide screen of 3840 px, 67 px a degree.
// Throws std::invalid_argument when the sizes differ.
FlipResult measureFlip(const Image& reference, const Image& test);

}  // namespace viewer
