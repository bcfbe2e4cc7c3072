#include "viewer/context/gl_context.h"

#include <glad/gl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "viewer/context/backends.h"

namespace viewer {

namespace {

constexpr std::array<std::pair<Backend, std::string_view>, 4> kNames = {
    {{Backend::Auto, "auto"}, {Backend::OsMesa, "osmesa"}, {Backend::Egl, "egl"}, {Backend::Glfw, "glfw"}}};

// What these variables change is either the picture or whether there is one.
bool changesRasterizer(const std::string& variable) {
  if (variable == "LP_NUM_THREADS") return false;
  for (const char* prefix : {"LP_", "GALLIVM_", "GALLIUM_", "MESA_", "LIBGL_"})
    if (variable.starts_with(prefix)) return true;
  return false;
}

std::unique_ptr<GlContext> open(Backend backend) {
  switch (backend) {
    case Backend::OsMesa:
      return openOsMesa();
    case Backend::Egl:
      return openEgl();
    default:
      return openHiddenGlfw();
  }
}

}  // namespace

std::optional<Backend> parseBackend(std::string_view text) {
  for (const auto& [backend, backend_name] : kNames)
    if (backend_name == text) return backend;
  return std::nullopt;
}

std::string_view name(Backend backend) { return kNames[size_t(backend)].second; }

void clearRasterizerEnvironment() {
  std::vector<std::string> variables;
  for (char** v = environ; v && *v; ++v) {
    const char* end = std::strchr(*v, '=');
    if (end) variables.emplace_back(*v, size_t(end - *v));
  }
  for (const std::string& variable : variables)
    if (changesRasterizer(variable)) unsetenv(variable.c_str());
}

GlContext::GlContext() : gl_(std::make_unique<GladGLContext>()) {}
GlContext::~GlContext() = default;

void GlContext::load(GetProcAddress get) {
  const int version = gladLoadGLContext(gl_.get(), get);
  if (version < GLAD_MAKE_VERSION(3, 3))
    throw ContextError("OpenGL 3.3 is needed, the context has " +
                       std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                       std::to_string(GLAD_VERSION_MINOR(version)));
}

std::unique_ptr<GlContext> makeContext(const ContextRequest& request, std::vector<std::string>* passed_over) {
  clearRasterizerEnvironment();
  std::vector<Backend> order = {request.backend};
  if (request.backend == Backend::Auto) order = {Backend::OsMesa, Backend::Egl};
  std::string reasons;
  for (const Backend backend : order) {
    try {
      return open(backend);
    } catch (const ContextError& error) {
      const std::string reason = std::string(name(backend)) + ": " + error.what();
      if (passed_over) passed_over->push_back(reason);
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
  }
  throw ContextError("no OpenGL context (" + reasons + ")");
}

}  // namespace viewer
