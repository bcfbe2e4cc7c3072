// Range reduction followed by a Taylor series that is long enough for double precision on the reduced range.
#include "pfx/base_level/math/trig.h"

#include <cmath>

namespace pfx {
namespace {

// pi/2 split in two, so that k * kHalfPiHigh is exact for |k| < 2^20 (Cody and Waite, Software Manual for the
// Elementary Functions, 1980).
constexpr double kHalfPiHigh = 1.5707963267341256;
constexpr double kHalfPiLow = 6.0771005065061922e-11;
constexpr double kLn2High = 0.69314718036912382;
constexpr double kLn2Low = 1.9082149292705877e-10;

// sum over k of x^(first + 2k) * (-1)^k / (first + 2k)!, |x| <= pi/4
double alternatingSeries(double x, int first) {
  const double x2 = x * x;
  double term = first == 0 ? 1.0 : x;
  double sum = term;
  for (int n = first + 2; n < 20; n += 2) {
    term *= -x2 / ((n - 1) * n);
    sum += term;
  }
  return sum;
}

// |x| <= tan(pi/8)
double atanSeries(double x) {
  const double x2 = x * x;
  double sum = 0.0;
  for (int n = 41; n >= 1; n -= 2) sum = 1.0 / n - x2 * sum;
  return x * sum;
}

double atanPositive(double x) {
  constexpr double kTanPi8 = 0.41421356237309503;
  if (x > 1.0) return 0.5 * kPiDouble - atanPositive(1.0 / x);
  if (x > kTanPi8) return 0.25 * kPiDouble + atanSeries((x - 1.0) / (x + 1.0));
  return atanSeries(x);
}

}  // namespace

SinCosDouble sincos(double radians) {
  const double k = std::floor(radians * (2.0 / kPiDouble) + 0.5);
  const double r = (radians - k * kHalfPiHigh) - k * kHalfPiLow;
  const double s = alternatingSeries(r, 1);
  const double c = alternatingSeries(r, 0);
  switch (static_cast<long long>(k) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

double atan2(double y, double x) {
  if (x == 0.0 && y == 0.0) return 0.0;
  const double ax = std::fabs(x), ay = std::fabs(y);
  double angle = ax >= ay ? atanPositive(ay / ax) : 0.5 * kPiDouble - atanPositive(ax / ay);
  if (x < 0.0) angle = kPiDouble - angle;
  return y < 0.0 ? -angle : angle;
}

double asin(double x) {
  x = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double acos(double x) {
  x = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double exp(double x) {
  const double k = std::floor(x / (kLn2High + kLn2Low) + 0.5);
  if (k < -1070.0) return 0.0;
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double term = 1.0, sum = 1.0;
  for (int n = 1; n < 16; ++n) {
    term *= r / n;
    sum += term;
  }
  return std::ldexp(sum, static_cast<int>(k));
}

double log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // 0.5 .. 1
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  // log(m) = 2 atanh((m - 1) / (m + 1))
  const double t = (m - 1.0) / (m + 1.0), t2 = t * t;
  double sum = 0.0;
  for (int n = 25; n >= 1; n -= 2) sum = 1.0 / n + t2 * sum;
  return (exponent * kLn2Low + 2.0 * t * sum) + exponent * kLn2High;
}

double pow(double x, double y) { return exp(y * log(x)); }

}  // namespace pfx
