#include "viewer/browse/commands.h"

#include <algorithm>
#include <array>

namespace viewer {

std::span<const KeyBinding> keyBindings() {
  using enum BrowseCommand;
  static constexpr std::array kTable = {
      KeyBinding{Pause, key::kSpace, false, false, "Space", "pause or go on"},
      KeyBinding{Step, key::kPeriod, false, false, ".", "one step"},
      KeyBinding{StepFive, key::kPeriod, false, true, "Shift+.", "five steps"},
      KeyBinding{StepBack, key::kComma, false, false, ",", "one step back"},
      KeyBinding{StepBackFive, key::kComma, false, true, "Shift+,", "five steps back"},
      KeyBinding{Restart, 'R', false, false, "R", "restart the scene"},
      KeyBinding{NextScene, key::kRightBracket, false, false, "]", "next scene"},
      KeyBinding{PreviousScene, key::kLeftBracket, false, false, "[", "previous scene"},
      KeyBinding{Find, 'O', true, false, "Ctrl+O", "find a scene by name"},
      KeyBinding{Slower, key::kMinus, false, false, "-", "half the speed"},
      KeyBinding{Faster, key::kEqual, false, false, "=", "twice the speed"},
      KeyBinding{Frame, 'F', false, false, "F", "look at the selection, or at everything"},
      KeyBinding{ResetCamera, key::kHome, false, false, "Home", "the scene's own view"},
      KeyBinding{ViewFront, '1', false, false, "1", "view from the front"},
      KeyBinding{ViewSide, '2', false, false, "2", "view from the right"},
      KeyBinding{ViewTop, '3', false, false, "3", "view from above"},
      KeyBinding{Orthographic, '4', false, false, "4", "parallel or perspective view"},
      KeyBinding{Follow, 'T', false, false, "T", "follow the selection"},
      KeyBinding{Deselect, key::kEscape, false, false, "Esc", "select nothing"},
      KeyBinding{Throw, 'B', false, false, "B", "throw a ball to where the mouse points"},
      KeyBinding{ToggleAabb, 'A', false, true, "Shift+A", "show bounds"},
      KeyBinding{ToggleAxes, 'X', false, true, "Shift+X", "show local axes"},
      KeyBinding{ToggleContacts, 'C', false, true, "Shift+C", "show contacts"},
      KeyBinding{ToggleIslands, 'I', false, true, "Shift+I", "show islands"},
      KeyBinding{ToggleJoints, 'J', false, true, "Shift+J", "show joints"},
      KeyBinding{ToggleVelocity, 'V', false, true, "Shift+V", "show velocities"},
      KeyBinding{ToggleWorld, 'W', false, true, "Shift+W", "show the box of the world"},
      KeyBinding{Pause, 'P', false, false, "P", "pause, where Space jumps"},
      KeyBinding{Steer, 'G', false, false, "G", "steer the scene, or fly the camera"},
      KeyBinding{Record, 'R', true, false, "Ctrl+R", "record every step, or stop"},
      KeyBinding{Screenshot, key::kF12, false, false, "F12", "save a picture"},
      KeyBinding{ToggleUi, key::kTab, false, false, "Tab", "hide or show all panels"},
      KeyBinding{ToggleCosts, 'M', false, false, "M", "hide or show the costs"},
      KeyBinding{Help, key::kF1, false, false, "F1", "this list"},
      KeyBinding{Quit, 'Q', true, false, "Ctrl+Q", "quit"},
  };
  return kTable;
}

std::optional<BrowseCommand> commandOf(const KeyEvent& event) {
  if (!event.down || event.alt) return std::nullopt;
  const auto all = keyBindings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const KeyBinding& b) {
    return b.key == event.key && b.control == event.control && b.shift == event.shift;
  });
  return found == all.end() ? std::nullopt : std::optional(found->command);
}

std::span<const MouseHelp> mouseHelp() {
  static constexpr std::array kTable = {
      MouseHelp{"left click", "select what is under the mouse: body, triangle, contact, joint"},
      MouseHelp{"left drag", "turn the view"},
      MouseHelp{"right or middle drag", "move the view"},
      MouseHelp{"wheel", "nearer or farther"},
      MouseHelp{"Ctrl + left drag", "pull the body under the mouse, with limited force"},
      MouseHelp{"W A S D Q E", "fly forwards, left, back, right, down, up"},
      MouseHelp{"W A S D, Space, Shift, Ctrl", "in scenes that are steered: walk, jump, run, crouch"},
  };
  return kTable;
}

}  // namespace viewer
