// What keys do in the browser: one table, from which the keyboard works and the help is made.
#pragma once

#include <optional>
#include <span>

#include "viewer/context/window.h"

namespace viewer {

enum class BrowseCommand {
  Pause,
  Step,
  StepFive,
  StepBack,
  StepBackFive,
  Restart,
  NextScene,
  PreviousScene,
  Find,
  Frame,
  ResetCamera,
  ViewFront,
  ViewSide,
  ViewTop,
  Orthographic,
  Follow,
  Deselect,
  Slower,
  Faster,
  Throw,
  Screenshot,
  Record,
  Steer,
  ToggleUi,
  ToggleCosts,
  Help,
  Quit,
  ToggleAabb,
  ToggleAxes,
  ToggleContacts,
  ToggleIslands,
  ToggleJoints,
  ToggleVelocity,
  ToggleWorld,
};

struct KeyBinding {
  BrowseCommand command;
  int key;
  bool control, shift;
  const char* keys;  // as printed
  const char* help;
};
std::span<const KeyBinding> keyBindings();

// Nothing when no binding has these keys, or the key was released.
std::optional<BrowseCommand> commandOf(const KeyEvent& event);

// What the mouse does, for the help.
struct MouseHelp {
  const char* gesture;
  const char* help;
};
std::span<const MouseHelp> mouseHelp();

}  // namespace viewer
