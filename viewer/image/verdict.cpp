// The two rules of the verdict.
#include "viewer/image/verdict.h"

#include <cmath>
#include <cstdio>

namespace viewer {
namespace {

std::string sizeText(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void judgeSame(Verdict& v, size_t num_pixels, const Limits& limits) {
  const ImageDifference& d = v.difference;
  const auto allowed = uint32_t(std::floor(limits.pixels_over * double(num_pixels)));
  if (d.max_channel > limits.max_channel)
    v.why = "a channel differs by " + std::to_string(d.max_channel) + " levels, " +
            std::to_string(limits.max_channel) + " allowed";
  else if (d.pixels_over > allowed)
    v.why = std::to_string(d.pixels_over) + " pixels differ visibly, " + std::to_string(allowed) + " allowed";
  else if (d.max_block > limits.max_block)
    v.why = "an 8x8 block differs by " + number(double(d.max_block)) + " levels, " +
            number(double(limits.max_block)) + " allowed";
  else
    v.pass = true, v.why = "within rounding: at most " + std::to_string(d.max_channel) + " levels";
}

void judgeOther(Verdict& v, const Image& golden, const Image& actual, const Limits& limits) {
  v.flip = measureFlip(golden, actual);
  const FlipResult& flip = *v.flip;
  if (flip.max_block > limits.other_max_block_flip)
    v.why = "another rasteriser, and an 8x8 block has FLIP " + number(double(flip.max_block)) + ", " +
            number(double(limits.other_max_block_flip)) + " allowed";
  else if (flip.mean > limits.other_mean_flip)
    v.why = "another rasteriser, and mean FLIP is " + number(double(flip.mean)) + ", " +
            number(double(limits.other_mean_flip)) + " allowed";
  else
    v.pass = true, v.why = "looks the same on another rasteriser (looser rule)";
}

}  // namespace

Verdict judge(const Image& golden, const Image& actual, Rasteriser rasteriser, const Limits& limits) {
  Verdict v;
  if (!golden.sameSize(actual) || golden.rgba.size() != actual.rgba.size()) {
    v.why = "sizes differ: " + sizeText(golden) + " and " + sizeText(actual);
    return v;
  }
  v.difference = measureDifference(golden, actual);
  v.exact = v.difference.equal();
  if (v.exact)
    v.pass = true, v.why = "every pixel is equal";
  else if (rasteriser == Rasteriser::Same)
    judgeSame(v, golden.numPixels(), limits);
  else
    judgeOther(v, golden, actual, limits);
  return v;
}

}  // namespace viewer
