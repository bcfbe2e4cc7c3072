// Distances of pixels and blocks, and the pictures that show them.
#include "viewer/image/metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace viewer {
namespace {

void requireSameSize(const Image& a, const Image& b) {
  if (!a.sameSize(b) || a.rgba.size() != b.rgba.size())
    throw std::invalid_argument("images of different size cannot be compared");
}

int distance(const uint8_t* a, const uint8_t* b) {
  int d = 0;
  for (int c = 0; c < 4; ++c) d = std::max(d, std::abs(int(a[c]) - int(b[c])));
  return d;
}

}  // namespace

ImageDifference measureDifference(const Image& a, const Image& b) {
  requireSameSize(a, b);
  ImageDifference out;
  std::vector<uint32_t> sums(size_t((a.width + kBlock - 1) / kBlock));
  for (int y0 = 0; y0 < a.height; y0 += kBlock) {
    const int y1 = std::min(y0 + kBlock, a.height);
    std::fill(sums.begin(), sums.end(), 0u);
    for (int y = y0; y < y1; ++y) {
      const size_t row = size_t(y) * size_t(a.width) * 4;
      for (int x = 0; x < a.width; ++x) {
        const int d = distance(&a.rgba[row + size_t(x) * 4], &b.rgba[row + size_t(x) * 4]);
        out.max_channel = std::max(out.max_channel, d);
        out.pixels_over += d > kVisibleLevels;
        sums[size_t(x / kBlock)] += uint32_t(d);
      }
    }
    for (size_t block = 0; block < sums.size(); ++block) {
      const int x0 = int(block) * kBlock;
      const int pixels = (y1 - y0) * (std::min(x0 + kBlock, a.width) - x0);
      const float mean = float(sums[block]) / float(pixels);
      if (mean > out.max_block) out.max_block = mean, out.worst_x = x0, out.worst_y = y0;
    }
  }
  return out;
}

Image differenceImage(const Image& a, const Image& b) {
  requireSameSize(a, b);
  constexpr int kAmplify = 8;
  Image out{a.width, a.height, std::vector<uint8_t>(a.rgba.size(), 255)};
  for (size_t i = 0; i < a.rgba.size(); i += 4) {
    const int grey = std::min(255, kAmplify * distance(&a.rgba[i], &b.rgba[i]));
    std::fill_n(&out.rgba[i], 3, uint8_t(grey));
  }
  return out;
}

Image heatImage(int width, int height, const std::vector<float>& values) {
  static constexpr std::array<std::array<float, 3>, 6> kStops = {
      {{0, 0, 0}, {60, 15, 110}, {185, 35, 90}, {240, 110, 30}, {250, 205, 60}, {255, 255, 240}}};
  Image out{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4, 255)};
  for (size_t i = 0; i < std::min(values.size(), out.numPixels()); ++i) {
    const float at = std::clamp(values[i], 0.0f, 1.0f) * float(kStops.size() - 1);
    const size_t stop = std::min(size_t(at), kStops.size() - 2);
    const float part = at - float(stop);
    for (size_t c = 0; c < 3; ++c)
      out.rgba[i * 4 + c] =
          uint8_t(std::lround(kStops[stop][c] + part * (kStops[stop + 1][c] - kStops[stop][c])));
  }
  return out;
}

}  // namespace viewer
