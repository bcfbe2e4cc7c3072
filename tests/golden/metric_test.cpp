// The image metric, FLIP and the verdict: closed forms, and seeded defects that must not pass.
#include "viewer/image/metric.h"

#include <gtest/gtest.h>

#include "pictures.h"
#include "viewer/image/flip.h"
#include "viewer/image/verdict.h"

namespace golden_tests {
using namespace viewer;

Image flat(int width, int height, uint8_t r, uint8_t g, uint8_t b) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.rgba.insert(image.rgba.end(), {r, g, b, 255});
  return image;
}

TEST(Metric, CountsExactlyTheChangedPixels) {
  const Image a = flat(32, 24, 100, 100, 100);
  Image b = a;
  b.rgba[4 * (9 * 32 + 17) + 1] = 110;  // block (2, 1)
  b.rgba[4 * (9 * 32 + 18) + 2] = 97;   // three levels: not counted as visible
  const ImageDifference d = measureDifference(a, b);
  EXPECT_EQ(d.max_channel, 10);
  EXPECT_EQ(d.pixels_over, 1u);
  EXPECT_FLOAT_EQ(d.max_block, 13.0f / 64.0f);
  EXPECT_EQ(d.worst_x, 16);
  EXPECT_EQ(d.worst_y, 8);
}

TEST(Metric, BlocksAtTheBorderAreAveragedOverThePixelsTheyHave) {
  const Image a = flat(9, 9, 0, 0, 0);
  Image b = a;
  b.rgba[4 * 80] = 40;  // the last pixel is a block of its own
  EXPECT_FLOAT_EQ(measureDifference(a, b).max_block, 40.0f);
}

TEST(Metric, RefusesImagesOfDifferentSize) {
  EXPECT_THROW(measureDifference(flat(8, 8, 0, 0, 0), flat(8, 9, 0, 0, 0)), std::invalid_argument);
  EXPECT_THROW(measureFlip(flat(8, 8, 0, 0, 0), flat(9, 8, 0, 0, 0)), std::invalid_argument);
}

TEST(Flip, IsZeroForEqualPictures) {
  const Image a = drawPicture(Change::None);
  const FlipResult flip = measureFlip(a, a);
  EXPECT_EQ(flip.mean, 0.0f);
  EXPECT_EQ(flip.max_block, 0.0f);
}

// Without edges FLIP is the redistributed colour distance, which can be written down. Black and white: the
// HyAB distance is 100; green and blue, the largest: 203.3017 (their Lab coordinates with the Hunt
// adjustment, in double precision).
TEST(Flip, OfBlackAndWhiteFollowsThePapersFormula) {
  const float limit = std::pow(203.3017f, 0.7f), d = std::pow(100.0f, 0.7f);
  const float expected = 0.95f + 0.05f * (d - 0.4f * limit) / (limit - 0.4f * limit);
  const FlipResult flip = measureFlip(flat(40, 40, 0, 0, 0), flat(40, 40, 255, 255, 255));
  EXPECT_NEAR(flip.mean, expected, 1e-5f);  // float rounding
  EXPECT_NEAR(flip.max_block, expected, 1e-5f);
}

TEST(Flip, OfGreenAndBlueIsOneAndSymmetric) {
  const Image green = flat(40, 40, 0, 255, 0), blue = flat(40, 40, 0, 0, 255);
  EXPECT_NEAR(measureFlip(green, blue).mean, 1.0f, 1e-4f);  // float rounding of the colour transforms
  EXPECT_NEAR(measureFlip(blue, green).mean, measureFlip(green, blue).mean, 1e-6f);
}

TEST(Flip, ShowsADefectWhereItIs) {
  const Image a = drawPicture(Change::None), b = drawPicture(Change::BoxMissing);
  const FlipResult flip = measureFlip(a, b);
  EXPECT_LT(flip.mean, 0.01f);      // 432 of 230400 pixels
  EXPECT_GT(flip.max_block, 0.3f);  // the box
  // Radius of the widest filter is 10 px: further away nothing may differ.
  EXPECT_EQ(flip.map[size_t(340) * 640 + 600], 0.0f);
}

TEST(Verdict, EqualPicturesAreExact) {
  const Verdict v = judge(drawPicture(Change::None), drawPicture(Change::None), Rasteriser::Same);
  EXPECT_TRUE(v.pass);
  EXPECT_TRUE(v.exact);
}

TEST(Verdict, RoundingNoisePasses) {
  const Image a = drawPicture(Change::None), b = drawPicture(Change::RoundingNoise);
  for (const Rasteriser r : {Rasteriser::Same, Rasteriser::Other}) {
    const Verdict v = judge(a, b, r);
    EXPECT_TRUE(v.pass) << v.why;
    EXPECT_FALSE(v.exact);
  }
}

class SeededDefect : public testing::TestWithParam<Change> {};

TEST_P(SeededDefect, FailsOnTheSameRasteriser) {
  const Verdict v = judge(drawPicture(Change::None), drawPicture(GetParam()), Rasteriser::Same);
  EXPECT_FALSE(v.pass) << v.why;
}

INSTANTIATE_TEST_SUITE_P(All, SeededDefect,
                         testing::Values(Change::BoxMissing, Change::BoxMovedOneCentimetre,
                                         Change::ColourFivePercent, Change::LineMissing,
                                         Change::DigitChanged),
                         kChangeName);

class VisibleDefect : public testing::TestWithParam<Change> {};

TEST_P(VisibleDefect, FailsOnAnotherRasteriserToo) {
  const Verdict v = judge(drawPicture(Change::None), drawPicture(GetParam()), Rasteriser::Other);
  EXPECT_FALSE(v.pass) << v.why;
}

INSTANTIATE_TEST_SUITE_P(All, VisibleDefect,
                         testing::Values(Change::BoxMissing, Change::LineMissing, Change::DigitChanged),
                         kChangeName);

TEST(Verdict, ThresholdsAreInclusive) {
  const Image a = flat(640, 360, 100, 100, 100);
  Image b = a;
  b.rgba[0] = 108;
  EXPECT_TRUE(judge(a, b, Rasteriser::Same).pass);  // 8 levels, 1 pixel, block mean 1/8
  b.rgba[0] = 109;
  EXPECT_FALSE(judge(a, b, Rasteriser::Same).pass);
  b = a;
  for (size_t i = 0; i < 46; ++i) b.rgba[i * 4 * 100] = 104;  // 0.02 % of 230400 is 46.08
  EXPECT_TRUE(judge(a, b, Rasteriser::Same).pass);
  b.rgba[46 * 4 * 100] = 104;
  EXPECT_FALSE(judge(a, b, Rasteriser::Same).pass);
  b = a;
  for (size_t y = 0; y < 8; ++y)
    for (size_t x = 0; x < 8; ++x) b.rgba[(y * 640 + x) * 4] = 101;
  EXPECT_TRUE(judge(a, b, Rasteriser::Same).pass);  // block mean exactly 1
  b.rgba[0] = 102;
  EXPECT_FALSE(judge(a, b, Rasteriser::Same).pass);
}

TEST(Verdict, DifferentSizesFailAndSaySo) {
  const Verdict v = judge(flat(8, 8, 0, 0, 0), flat(16, 8, 0, 0, 0), Rasteriser::Same);
  EXPECT_FALSE(v.pass);
  EXPECT_EQ(v.why, "sizes differ: 8x8 and 16x8");
}

TEST(HeatMap, EndsInBlackAndNearWhite) {
  const Image heat = heatImage(2, 1, {0.0f, 1.0f});
  EXPECT_EQ(heat.rgba, (std::vector<uint8_t>{0, 0, 0, 255, 255, 255, 240, 255}));
}

}  // namespace golden_tests
