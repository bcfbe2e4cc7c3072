#include "viewer/browse/ui_input.h"

#include <imgui.h>

#include <algorithm>
#include <set>

namespace viewer {

void UiInput::add(const WindowInput& input) {
  keys_.insert(keys_.end(), input.keys.begin(), input.keys.end());
  buttons_.insert(buttons_.end(), input.buttons.begin(), input.buttons.end());
  characters_.insert(characters_.end(), input.characters.begin(), input.characters.end());
  mouse_x_ = input.mouse_x;
  mouse_y_ = input.mouse_y;
  frame_.wheel_x += input.wheel_x;
  frame_.wheel_y += input.wheel_y;
  // Releases outside of the window never arrive.
  if (!input.focused) {
    frame_.down.clear();
    std::fill(std::begin(frame_.held), std::end(frame_.held), false);
  }
}

const UiInput::Frame& UiInput::next() {
  frame_.keys.clear();
  frame_.buttons.clear();
  frame_.characters.clear();
  const bool kept = kept_frames_ > 0;
  kept_frames_ -= kept;
  if (!kept) frame_.characters.swap(characters_);

  // A button acts where the mouse was in that moment, wherever it has gone since.
  frame_.mouse_x = buttons_.empty() ? mouse_x_ : buttons_.front().x;
  frame_.mouse_y = buttons_.empty() ? mouse_y_ : buttons_.front().y;
  std::set<int> changed;
  while (!buttons_.empty() && buttons_.front().x == frame_.mouse_x && buttons_.front().y == frame_.mouse_y &&
         changed.insert(buttons_.front().button).second) {
    frame_.held[buttons_.front().button] = buttons_.front().down;
    frame_.buttons.push_back(buttons_.front());
    buttons_.pop_front();
  }
  changed.clear();
  bool shortcut = false;
  while (!kept && !shortcut && !keys_.empty() && changed.insert(keys_.front().key).second) {
    const KeyEvent& e = keys_.front();
    frame_.down[e.key] = e.down;
    shortcut = e.down && e.control;
    frame_.keys.push_back(e);
    keys_.pop_front();
  }
  const auto either = [&](int left, int right) { return frame_.isDown(left) || frame_.isDown(right); };
  frame_.control = either(key::kLeftControl, key::kRightControl);
  frame_.shift = either(key::kLeftShift, key::kRightShift);
  frame_.alt = either(key::kLeftAlt, key::kRightAlt);
  return frame_;
}

void UiInput::keepTyping(int frames) {
  kept_frames_ = frames;
  characters_.insert(characters_.begin(), frame_.characters.begin(), frame_.characters.end());
}

void UiInput::endFrame() { frame_.wheel_x = frame_.wheel_y = 0.0f; }

void setKeyMap(ImGuiIO& io) {
  io.KeyMap[ImGuiKey_Tab] = key::kTab;
  io.KeyMap[ImGuiKey_LeftArrow] = key::kLeft;
  io.KeyMap[ImGuiKey_RightArrow] = key::kRight;
  io.KeyMap[ImGuiKey_UpArrow] = key::kUp;
  io.KeyMap[ImGuiKey_DownArrow] = key::kDown;
  io.KeyMap[ImGuiKey_PageUp] = key::kPageUp;
  io.KeyMap[ImGuiKey_PageDown] = key::kPageDown;
  io.KeyMap[ImGuiKey_Home] = key::kHome;
  io.KeyMap[ImGuiKey_End] = key::kEnd;
  io.KeyMap[ImGuiKey_Insert] = key::kInsert;
  io.KeyMap[ImGuiKey_Delete] = key::kDelete;
  io.KeyMap[ImGuiKey_Backspace] = key::kBackspace;
  io.KeyMap[ImGuiKey_Space] = key::kSpace;
  io.KeyMap[ImGuiKey_Enter] = key::kEnter;
  io.KeyMap[ImGuiKey_Escape] = key::kEscape;
  io.KeyMap[ImGuiKey_KeyPadEnter] = key::kKeypadEnter;
  for (const auto& [map, letter] : {std::pair(ImGuiKey_A, 'A'),
                                    {ImGuiKey_C, 'C'},
                                    {ImGuiKey_V, 'V'},
                                    {ImGuiKey_X, 'X'},
                                    {ImGuiKey_Y, 'Y'},
                                    {ImGuiKey_Z, 'Z'}})
    io.KeyMap[map] = letter;
}

void feed(ImGuiIO& io, const UiInput::Frame& frame, const UiDisplay& display) {
  io.DisplaySize = ImVec2(float(display.width), float(display.height));
  io.DeltaTime = display.dt;
  io.MousePos = ImVec2(frame.mouse_x, frame.mouse_y);
  io.MouseWheel = frame.wheel_y;
  io.MouseWheelH = frame.wheel_x;
  for (int b = 0; b < 3; ++b) io.MouseDown[b] = frame.held[b];
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  for (const auto& [code, down] : frame.down)
    if (code >= 0 && code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[code] = down;
  io.KeyCtrl = frame.control;
  io.KeyShift = frame.shift;
  io.KeyAlt = frame.alt;
  for (const uint32_t c : frame.characters) io.AddInputCharacter(c);
}

}  // namespace viewer
