// Looks of the user interface: font and colours.
#pragma once

namespace viewer {

// Sets up the current ImGui context for a scale of the display (1: 96 dots an inch).
void setUiStyle(float scale);

}  // namespace viewer
