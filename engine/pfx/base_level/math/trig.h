// Elementary functions with the same bits on every machine.
//
// The C library picks an implementation by processor, and the compiler may fold a call at compile time with
// another rounding, so sin(1.0f) is not one number. These use only +, -, *, / and sqrt, in double, and are
// accurate to about 1e-15 for |x| < 1e5; the float overloads round that result once.
#pragma once

namespace pfx {

inline constexpr double kPiDouble = 3.14159265358979323846;
inline constexpr float kPi = 3.14159265f;

struct SinCosDouble {
  double sin, cos;
};
struct SinCos {
  float sin, cos;
};

SinCosDouble sincos(double radians);
double atan2(double y, double x);  // -pi .. pi; 0 for (0, 0)
double exp(double x);
double log(double x);  // x > 0

inline SinCos sincos(float radians) {
  const SinCosDouble r = sincos(static_cast<double>(radians));
  return {static_cast<float>(r.sin), static_cast<float>(r.cos)};
}
inline double sin(double radians) { return sincos(radians).sin; }
inline double cos(double radians) { return sincos(radians).cos; }
inline double tan(double radians) {
  const SinCosDouble r = sincos(radians);
  return r.sin / r.cos;
}
double asin(double x);  // x is clamped to -1 .. 1
double acos(double x);
double pow(double x, double y);  // x > 0

inline float sin(float x) { return static_cast<float>(sin(static_cast<double>(x))); }
inline float cos(float x) { return static_cast<float>(cos(static_cast<double>(x))); }
inline float tan(float x) { return static_cast<float>(tan(static_cast<double>(x))); }
inline float asin(float x) { return static_cast<float>(asin(static_cast<double>(x))); }
inline float acos(float x) { return static_cast<float>(acos(static_cast<double>(x))); }
inline float atan2(float y, float x) {
  return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float exp(float x) { return static_cast<float>(exp(static_cast<double>(x))); }
inline float log(float x) { return static_cast<float>(log(static_cast<double>(x))); }
inline float pow(float x, float y) {
  return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y)));
}

}  // namespace pfx
