// Feeds window input to Dear ImGui, one change of a button or key a frame.
//
// Version 1.86 of the library looks at the state of buttons once a frame: a press and a release that arrive
// together would never be seen. What cannot be shown in this frame waits for the next.
#pragma once

#include <deque>
#include <map>

#include "viewer/context/window.h"

struct ImGuiIO;

namespace viewer {

class UiInput {
 public:
  // Remembers what happened, in its order.
  void add(const WindowInput& input);

  struct Frame {
    std::vector<KeyEvent> keys;  // presses and releases that this frame shows
    std::vector<ButtonEvent> buttons;
    std::vector<uint32_t> characters;
    float mouse_x = -1.0f, mouse_y = -1.0f, wheel_x = 0.0f, wheel_y = 0.0f;
    bool held[3] = {};  // buttons after this frame's events
    bool control = false, shift = false, alt = false;
    bool isDown(int key) const { return down.contains(key) && down.at(key); }
    std::map<int, bool> down;  // keys after this frame's events
  };
  // The next frame: every button and key changes at most once in it, and a key that came with Ctrl is its last one.
  const Frame& next();
  // Keeps what is typed, that of this frame included, for so many frames: until a field that was asked for has the keyboard.
  void keepTyping(int frames);
  // The wheel's turns were used.
  void endFrame();

  bool waiting() const { return !keys_.empty() || !buttons_.empty() || !characters_.empty(); }

 private:
  std::deque<KeyEvent> keys_;
  std::deque<ButtonEvent> buttons_;
  std::vector<uint32_t> characters_;
  int kept_frames_ = 0;                      // frames that keys and characters still wait
  float mouse_x_ = -1.0f, mouse_y_ = -1.0f;  // px, where it is now
  Frame frame_;
};

// Sets the library's key map; once after its context was made.
void setKeyMap(ImGuiIO& io);
// Tells the library what `frame` shows. Sizes in pixels, dt in seconds (> 0).
struct UiDisplay {
  int width, height;
  float dt;
};
void feed(ImGuiIO& io, const UiInput::Frame& frame, const UiDisplay& display);

}  // namespace viewer
