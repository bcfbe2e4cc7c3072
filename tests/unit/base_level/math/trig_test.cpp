// The elementary functions against the C library's, whose error is far below the tolerances here.
#include "pfx/base_level/math/trig.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(Trig, SineAndCosineAgreeWithTheLibrary) {
  for (int i = -20000; i <= 20000; ++i) {
    const double x = i * 0.00731;
    EXPECT_NEAR(pfx::sin(x), std::sin(x), 4e-15) << x;
    EXPECT_NEAR(pfx::cos(x), std::cos(x), 4e-15) << x;
  }
}

TEST(Trig, LargeArgumentsKeepTheirAccuracy) {
  for (double x : {1e3, 1e4, 9.9e4, -7.7e4}) EXPECT_NEAR(pfx::sin(x), std::sin(x), 1e-11) << x;
}

TEST(Trig, ArcFunctionsAgreeInAllQuadrants) {
  for (int i = 0; i < 720; ++i) {
    const double a = (i - 360) * pfx::kPiDouble / 360.0;
    const double x = 3.0 * std::cos(a), y = 3.0 * std::sin(a);
    EXPECT_NEAR(pfx::atan2(y, x), std::atan2(y, x), 1e-15);
  }
  for (int i = -100; i <= 100; ++i) {
    EXPECT_NEAR(pfx::asin(i / 100.0), std::asin(i / 100.0), 1e-15);
    EXPECT_NEAR(pfx::acos(i / 100.0), std::acos(i / 100.0), 1e-15);
  }
  EXPECT_EQ(pfx::atan2(0.0, 0.0), 0.0);
}

TEST(Trig, ExponentialAndLogarithmAreInverse) {
  for (int i = -300; i <= 300; ++i) {
    const double x = i * 0.1;
    EXPECT_NEAR(pfx::exp(x) / std::exp(x), 1.0, 1e-14) << x;
    EXPECT_NEAR(pfx::log(pfx::exp(x)), x, 1e-13) << x;
  }
  EXPECT_NEAR(pfx::pow(2.0, 0.5), std::sqrt(2.0), 1e-15);
}
