// Where floors may lie in shadow. Looking up the shadow map is half the cost of a floor, and most of a floor is out of
// reach of everything that throws a shadow.
#pragma once

#include <array>

#include "viewer/render/frame_block.h"
#include "viewer/render/gl_state.h"

namespace viewer {

// The part of the picture outside of which no floor of the list is in shadow; empty when nothing throws one.
ScreenRect shadowReach(const DrawList& list, const SunView& sun, const FrameBlock& frame);

// What is left of the picture round a part of it: below, above, left, right.
std::array<ScreenRect, 4> around(const ScreenRect& part, const FrameBlock& frame);

}  // namespace viewer
