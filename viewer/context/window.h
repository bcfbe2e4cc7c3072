// A window with its input, latched so that a press and a release between two frames are both seen.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/context/gl_context.h"

namespace viewer {

// Key codes: the letter or digit itself for those (A is 'A'), and the following for others.
namespace key {
inline constexpr int kSpace = ' ', kComma = ',', kMinus = '-', kPeriod = '.', kSlash = '/', kEqual = '=',
                     kLeftBracket = '[', kRightBracket = ']', kEscape = 256, kEnter = 257, kTab = 258,
                     kBackspace = 259, kInsert = 260, kDelete = 261, kRight = 262, kLeft = 263, kDown = 264,
                     kUp = 265, kPageUp = 266, kPageDown = 267, kHome = 268, kEnd = 269, kF1 = 290,
                     kF12 = 301, kKeypadEnter = 335, kLeftShift = 340, kLeftControl = 341, kLeftAlt = 342,
                     kRightShift = 344, kRightControl = 345, kRightAlt = 346;
inline constexpr int kCount = 349;
}  // namespace key

struct KeyEvent {
  int key;    // see above
  bool down;  // pressed or repeated; false: released
  bool repeat;
  bool control, shift, alt;
};

struct ButtonEvent {
  int button;  // 0 left, 1 right, 2 middle
  bool down;
  float x = -1.0f, y = -1.0f;  // px, of the mouse in that moment
};

// Everything that happened since the last poll, and what is held now. Positions are pixels of the
// framebuffer.
struct WindowInput {
  int width = 0, height = 0;  // px of the framebuffer
  float scale = 1.0f;         // of the user interface, for high-density displays
  float mouse_x = -1.0f, mouse_y = -1.0f;
  float wheel_x = 0.0f, wheel_y = 0.0f;  // steps
  bool focused = true;
  std::vector<KeyEvent> keys;
  std::vector<ButtonEvent> buttons;
  std::vector<uint32_t> characters;  // Unicode
};

struct WindowRequest {
  int width = 1280, height = 800;  // screen units
  std::string title = "Vitrine";
  bool visible = true;
};

class Window : public GlContext {
 public:
  virtual WindowInput poll() = 0;
  virtual void present() = 0;  // shows what was drawn into the default framebuffer
  virtual bool shouldClose() const = 0;
  virtual void setTitle(const std::string& title) = 0;
};

// Opens a window. Throws ContextError with the reason, for example that there is no display.
std::unique_ptr<Window> openWindow(const WindowRequest& request);

}  // namespace viewer
