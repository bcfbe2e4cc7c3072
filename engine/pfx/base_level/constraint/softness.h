// A constraint row that gives way like a spring and damper, with coefficients for implicit integration.
//
// Source: E. Catto, Soft Constraints, GDC 2011; E. Catto, Solver2D, 2024. With frequency f (Hz), damping
// ratio zeta and sub-step h: w = 2 pi f, a1 = 2 zeta + h w, a2 = h w a1, a3 = 1 / (1 + a2).
#pragma once

namespace pfx {

struct Softness {
  float bias_rate;      // 1/s: velocity asked for per metre of error
  float mass_scale;     // of the new impulse
  float impulse_scale;  // of the impulse gathered so far, which leaks
};

constexpr Softness makeSoftness(float frequency, float damping_ratio, float h) {
  const float w = 6.2831853f * frequency;
  const float a1 = 2.0f * damping_ratio + h * w;
  const float a2 = h * w * a1;
  const float a3 = 1.0f / (1.0f + a2);
  return {w / a1, a2 * a3, a3};
}

}  // namespace pfx
