// GLFW: a window on X11 or Wayland. The library is opened at run time; without its header at build time the
// backend reports that it is absent.
#include "viewer/context/backends.h"
#include "viewer/context/window.h"

#if __has_include(<GLFW/glfw3.h>)

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "viewer/context/library.h"

namespace viewer {

namespace {

#define VITRINE_GLFW(name) \
  decltype(&::glfw##name) name = library.function<decltype(&::glfw##name)>("glfw" #name)
struct Glfw {
  Library library{{"libglfw.so.3", "libglfw.so"}};
  VITRINE_GLFW(Init);
  VITRINE_GLFW(GetError);
  VITRINE_GLFW(WindowHint);
  VITRINE_GLFW(CreateWindow);
  VITRINE_GLFW(DestroyWindow);
  VITRINE_GLFW(MakeContextCurrent);
  VITRINE_GLFW(GetProcAddress);
  VITRINE_GLFW(SwapInterval);
  VITRINE_GLFW(SwapBuffers);
  VITRINE_GLFW(PollEvents);
  VITRINE_GLFW(WindowShouldClose);
  VITRINE_GLFW(SetWindowTitle);
  VITRINE_GLFW(SetWindowUserPointer);
  VITRINE_GLFW(GetWindowUserPointer);
  VITRINE_GLFW(GetFramebufferSize);
  VITRINE_GLFW(GetWindowSize);
  VITRINE_GLFW(GetWindowContentScale);
  VITRINE_GLFW(GetWindowAttrib);
  VITRINE_GLFW(SetKeyCallback);
  VITRINE_GLFW(SetCharCallback);
  VITRINE_GLFW(SetMouseButtonCallback);
  VITRINE_GLFW(SetCursorPosCallback);
  VITRINE_GLFW(SetScrollCallback);
};
#undef VITRINE_GLFW

// The library has state of its own, one a process; callbacks reach it without a context.
Glfw& glfw() {
  static Glfw api;
  return api;
}

[[noreturn]] void fail(const char* call) {
  const char* reason = nullptr;
  glfw().GetError(&reason);
  throw ContextError(std::string(call) + " failed: " + (reason ? reason : "no reason given"));
}

class GlfwWindow final : public Window {
 public:
  explicit GlfwWindow(const WindowRequest& request) {
    if (!glfw().Init()) fail("glfwInit");
    glfw().WindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfw().WindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfw().WindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfw().WindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfw().WindowHint(GLFW_DEPTH_BITS, 0);
    glfw().WindowHint(GLFW_STENCIL_BITS, 0);
    glfw().WindowHint(GLFW_VISIBLE, request.visible ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfw().CreateWindow(request.width, request.height, request.title.c_str(), nullptr, nullptr);
    if (!window_) fail("glfwCreateWindow");
    try {
      makeCurrent();
      load(glfw().GetProcAddress);
    } catch (const ContextError&) {
      glfw().DestroyWindow(window_);
      throw;
    }
    glfw().SwapInterval(1);
    listen();
  }
  ~GlfwWindow() override { glfw().DestroyWindow(window_); }

  Backend backend() const override { return Backend::Glfw; }
  void makeCurrent() override { glfw().MakeContextCurrent(window_); }
  void present() override { glfw().SwapBuffers(window_); }
  bool shouldClose() const override { return glfw().WindowShouldClose(window_); }
  void setTitle(const std::string& title) override { glfw().SetWindowTitle(window_, title.c_str()); }

  WindowInput poll() override {
    glfw().PollEvents();
    glfw().GetFramebufferSize(window_, &input_.width, &input_.height);
    float scale_y = 1.0f;
    glfw().GetWindowContentScale(window_, &input_.scale, &scale_y);
    input_.focused = glfw().GetWindowAttrib(window_, GLFW_FOCUSED);
    WindowInput seen = input_;
    input_.keys.clear();
    input_.buttons.clear();
    input_.characters.clear();
    input_.wheel_x = input_.wheel_y = 0.0f;
    return seen;
  }

 private:
  static WindowInput& inputOf(GLFWwindow* window) {
    return static_cast<GlfwWindow*>(glfw().GetWindowUserPointer(window))->input_;
  }

  void listen() {
    glfw().SetWindowUserPointer(window_, this);
    glfw().SetKeyCallback(window_, [](GLFWwindow* w, int code, int, int action, int mods) {
      if (code < 0 || code >= key::kCount) return;
      inputOf(w).keys.push_back({code, action != GLFW_RELEASE, action == GLFW_REPEAT,
                                 (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0,
                                 (mods & GLFW_MOD_ALT) != 0});
    });
    glfw().SetCharCallback(window_, [](GLFWwindow* w, unsigned c) { inputOf(w).characters.push_back(c); });
    glfw().SetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
      WindowInput& input = inputOf(w);
      if (button < 3) input.buttons.push_back({button, action == GLFW_PRESS, input.mouse_x, input.mouse_y});
    });
    glfw().SetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      // Screen units differ from pixels on high-density displays.
      int ww = 1, wh = 1, fw = 1, fh = 1;
      glfw().GetWindowSize(w, &ww, &wh);
      glfw().GetFramebufferSize(w, &fw, &fh);
      inputOf(w).mouse_x = float(x * fw / std::max(ww, 1));
      inputOf(w).mouse_y = float(y * fh / std::max(wh, 1));
    });
    glfw().SetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
      inputOf(w).wheel_x += float(x);
      inputOf(w).wheel_y += float(y);
    });
  }

  GLFWwindow* window_ = nullptr;
  WindowInput input_;
};

}  // namespace

std::unique_ptr<Window> openWindow(const WindowRequest& request) {
  clearRasterizerEnvironment();
  return std::make_unique<GlfwWindow>(request);
}

std::unique_ptr<GlContext> openHiddenGlfw() {
  return openWindow({.width = 64, .height = 64, .title = "", .visible = false});
}

}  // namespace viewer

#else

namespace viewer {

std::unique_ptr<Window> openWindow(const WindowRequest&) {
  throw ContextError("built without the header of GLFW");
}
std::unique_ptr<GlContext> openHiddenGlfw() { return openWindow({}); }

}  // namespace viewer

#endif
