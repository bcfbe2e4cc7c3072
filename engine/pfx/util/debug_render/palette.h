// The colours of the debug pictures: few, and each with one meaning.
#pragma once

#include <cstdint>

#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/util/debug_render/debug_render.h"

namespace pfx {

inline constexpr Color kAxisColors[3] = {0xffd64545u, 0xff4fa352u, 0xff3f72c4u};  // x, y, z
inline constexpr Color kWorldColor = 0xff8e959eu;
inline constexpr Color kContactPointColor = 0xfff2b33du;
inline constexpr Color kContactNormalColor = 0xffe3663au;
inline constexpr Color kContactOverlapColor = 0xffc0203cu, kContactGapColor = 0xff3f8fd0u;

// Edges of a large mesh: flat, convex, concave, open.
inline constexpr Color kEdgeColors[4] = {0xff9aa3ad, 0xffd98a3f, 0xff3f86b8, 0xffc8475a};
inline constexpr Color kThicknessColor = 0xffb9b2a6u;
inline constexpr Color kNormalColor = 0xff5f9e6eu;
inline constexpr Color kFacetBoxColor = 0xffb0a4c8u;

struct Look {
  Color color;
  Finish finish;
};

// How a body is painted: warm while it is awake, a little different from body to body; cool and dull asleep;
// the fixed world a light neutral, scripted bodies metallic blue, triggers a veil.
Look bodyLook(const RigidState& state, uint32_t body);

// A colour for an index, such that neighbours differ well: hues in steps of the golden ratio.
Color indexColor(uint32_t index);

// Opaque colour from hue (turns), saturation and value (0 .. 1).
Color hsvColor(float hue, float saturation, float value);

}  // namespace pfx
