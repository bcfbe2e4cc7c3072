// Colours by the state of a body and by index.
#include "pfx/util/debug_render/palette.h"

#include <algorithm>
#include <cmath>

namespace pfx {

namespace {

constexpr uint32_t kNumTypes = kNumMotionTypes;

// By motion type: awake, asleep. Active bodies that are awake vary around their entry.
struct Entry {
  Look awake, asleep;
};
constexpr Entry kLooks[kNumTypes] = {
    {{0xffbdbcb9u, Finish::Matte}, {0xffbdbcb9u, Finish::Matte}},              // Fixed
    {{0xffe0925au, Finish::Soft}, {0xff8593a3u, Finish::Dead}},                // Active
    {{0xff4a7ba6u, Finish::Metallic}, {0xff7f9ab3u, Finish::Metallic}},        // Keyframe
    {{0xff7fae8cu, Finish::Glossy}, {0xff8ea198u, Finish::Dead}},              // OneWay
    {{0x558f7fd0u, Finish::Translucent}, {0x558f7fd0u, Finish::Translucent}},  // Trigger
};

// The fractional part of index * k spreads over 0 .. 1 without repeating (Weyl sequence).
float spread(uint32_t index, uint32_t k) { return static_cast<float>((index * k) >> 8) * 0x1p-24f; }

uint32_t channel(float value) { return static_cast<uint32_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

// Between terracotta and amber, a shade lighter or darker.
Color warmColor(uint32_t body) {
  const float hue = 0.045f + 0.05f * spread(body, 2654435769u);
  const float saturation = 0.52f + 0.12f * spread(body, 3242174889u);
  const float value = 0.82f + 0.1f * spread(body, 1447445413u);
  return hsvColor(hue, saturation, value);
}

}  // namespace

Color hsvColor(float hue, float saturation, float value) {
  const auto component = [&](float offset) {
    const float turns = hue + offset;
    const float k = 6.0f * (turns - std::floor(turns));
    return channel(value * (1.0f - saturation * std::clamp(std::min(k, 4.0f - k), 0.0f, 1.0f)));
  };
  return 0xff000000u | component(5.0f / 6.0f) << 16 | component(3.0f / 6.0f) << 8 | component(1.0f / 6.0f);
}

Color indexColor(uint32_t index) {
  return hsvColor(spread(index, 2654435769u), 0.55f + 0.2f * spread(index, 3242174889u), 0.85f);
}

Look bodyLook(const RigidState& state, uint32_t body) {
  const uint32_t type = static_cast<uint32_t>(state.motion_type);
  if (type >= kNumTypes) return kLooks[0].awake;
  if (state.asleep) return kLooks[type].asleep;
  if (state.motion_type == MotionType::Active) return {warmColor(body), Finish::Soft};
  return kLooks[type].awake;
}

}  // namespace pfx
