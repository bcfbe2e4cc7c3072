// Synthetic pictures for the tests: shaded boxes on a ground, thin lines and digits, with one thing changed
// on demand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "viewer/image/image.h"

namespace golden_tests {

using viewer::Image;

// A seeded defect, or what may vary without harm.
enum class Change {
  None,
  BoxMissing,
  BoxMovedOneCentimetre,
  ColourFivePercent,
  LineMissing,
  DigitChanged,
  RoundingNoise
};

inline void setPixel(Image& image, int x, int y, const std::array<float, 3>& color, float coverage = 1.0f) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  uint8_t* px = &image.rgba[(size_t(y) * size_t(image.width) + size_t(x)) * 4];
  for (size_t c = 0; c < 3; ++c)
    px[c] = uint8_t(std::lround(float(px[c]) + coverage * (color[c] - float(px[c]))));
}

inline const char* nameOf(Change change) {
  switch (change) {
    case Change::None:
      return "None";
    case Change::BoxMissing:
      return "BoxMissing";
    case Change::BoxMovedOneCentimetre:
      return "BoxMovedOneCentimetre";
    case Change::ColourFivePercent:
      return "ColourFivePercent";
    case Change::LineMissing:
      return "LineMissing";
    case Change::DigitChanged:
      return "DigitChanged";
    case Change::RoundingNoise:
      return "RoundingNoise";
  }
  return "";
}

// Names the instances of tests that run once a change.
inline constexpr auto kChangeName = [](const auto& info) { return std::string(nameOf(info.param)); };

// A rectangle with antialiased left and right edges (px, may be fractions).
inline void fillBox(Image& image, float x0, float x1, int y0, int y1, const std::array<float, 3>& color) {
  for (int y = y0; y < y1; ++y)
    for (int x = int(std::floor(x0)); x <= int(std::floor(x1)); ++x) {
      const float coverage = std::clamp(std::min(float(x + 1), x1) - std::max(float(x), x0), 0.0f, 1.0f);
      setPixel(image, x, y, color, coverage);
    }
}

// Digits 3 and 8 of a 5x7 font at double size: they differ in 20 pixels of the left column.
inline void drawDigit(Image& image, int x0, int y0, bool eight) {
  static constexpr std::array<uint8_t, 7> kThree = {0b01110, 0b00001, 0b00001, 0b00110,
                                                    0b00001, 0b00001, 0b01110};
  static constexpr std::array<uint8_t, 7> kEight = {0b01110, 0b10001, 0b10001, 0b01110,
                                                    0b10001, 0b10001, 0b01110};
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 10; ++x)
      if ((eight ? kEight : kThree)[size_t(y / 2)] >> (4 - x / 2) & 1)
        setPixel(image, x0 + x, y0 + y, {20, 20, 20});
}

// 640x360, about 25 px to the metre: 1 cm is a quarter of a pixel.
inline Image drawPicture(Change change) {
  Image image{640, 360, {}};
  image.rgba.resize(image.numPixels() * 4, 255);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float sky = 235.0f - 0.2f * float(y);
      setPixel(image, x, y,
               y < 180 ? std::array{sky - 20, sky - 8, sky} : std::array{150.0f, 152.0f, 148.0f});
    }
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column <= row; ++column) {
      const bool chosen = row == 6 && column == 3;
      if (chosen && change == Change::BoxMissing) continue;
      float x = 320.0f + 26.0f * (float(column) - 0.5f * float(row));
      if (chosen && change == Change::BoxMovedOneCentimetre) x += 0.25f;
      const int y = 60 + 20 * row;
      std::array<float, 3> color = {200.0f - 9.0f * float(column), 120.0f + 5.0f * float(row), 70.0f};
      if (chosen && change == Change::ColourFivePercent) color[0] *= 0.95f;
      fillBox(image, x, x + 24.0f, y, y + 18, color);
    }
  for (int line = 0; line < 40; ++line) {
    if (line == 20 && change == Change::LineMissing) continue;
    for (int i = 0; i < 30; ++i) {
      setPixel(image, 30 + 12 * line + i / 2, 290 + i, {30, 60, 180}, 0.6f);
      setPixel(image, 31 + 12 * line + i / 2, 290 + i, {30, 60, 180}, 0.4f);
    }
  }
  for (int digit = 0; digit < 6; ++digit)
    drawDigit(image, 20 + 13 * digit, 20, digit == 3 ? change == Change::DigitChanged : digit % 2 == 0);
  if (change == Change::RoundingNoise) {
    std::mt19937 random(7);
    for (size_t i = 0; i < image.rgba.size(); i += 4)
      if (random() % 8 == 0) image.rgba[i + random() % 3] ^= 1;
  }
  return image;
}

}  // namespace golden_tests
