// A place where OpenGL 3.3 core can be called. Three backends stand behind it, each opened at run time, none
// linked: OSMesa and EGL without a surface draw offscreen, GLFW opens a window.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

struct GladGLContext;

namespace viewer {

enum class Backend { Auto, OsMesa, Egl, Glfw };

// "auto", "osmesa", "egl", "glfw"; nothing for any other name.
std::optional<Backend> parseBackend(std::string_view name);
std::string_view name(Backend backend);

struct ContextRequest {
  Backend backend = Backend::Auto;  // Auto: OSMesa, then EGL
};

// No backend could be opened; the text names each one that was tried and why it failed.
class ContextError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Contexts belong to the thread that made them. Renderers draw into framebuffers of their own and make their
// context current themselves; several contexts can live in one process.
class GlContext {
 public:
  virtual ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual Backend backend() const = 0;
  virtual void makeCurrent() = 0;

  const GladGLContext& gl() const { return *gl_; }

 protected:
  using Function = void (*)();
  using GetProcAddress = Function (*)(const char*);
  GlContext();
  // Loads the functions of the current context. Throws ContextError below GL 3.3.
  void load(GetProcAddress get);

 private:
  std::unique_ptr<GladGLContext> gl_;
};

// Opens an offscreen context (Glfw: of a hidden window, which needs a display). Throws ContextError. Reasons
// of backends that Auto passed over are appended to `passed_over` when it is given.
//
// Before the first call into GL it removes LP_*, GALLIVM_*, GALLIUM_*, MESA_* and LIBGL_* from the
// environment (except LP_NUM_THREADS): they change what is drawn or crash the software rasterizer. Call it
// before other threads read the environment.
std::unique_ptr<GlContext> makeContext(const ContextRequest& request,
                                       std::vector<std::string>* passed_over = nullptr);

}  // namespace viewer
