// EGL without a surface (EGL_MESA_platform_surfaceless): offscreen drawing without a display server.
#include <array>
#include <cstdint>
#include <cstdio>

#include "viewer/context/backends.h"
#include "viewer/context/library.h"

namespace viewer {

namespace {

// The part of EGL/egl.h that is used, declared here so that the program builds without it.
using Handle = void*;
using Function = void (*)();
constexpr unsigned kPlatformSurfaceless = 0x31DD, kOpenGlApi = 0x30A2, kTrue = 1;
constexpr int kNone = 0x3038, kMajorVersion = 0x3098, kMinorVersion = 0x30FB, kProfileMask = 0x30FD,
              kCoreBit = 1;

struct Egl {
  Library library{{"libEGL.so.1", "libEGL.so"}};
  Function (*get_proc_address)(const char*) =
      library.function<Function (*)(const char*)>("eglGetProcAddress");
  unsigned (*initialize)(Handle, int*,
                         int*) = library.function<unsigned (*)(Handle, int*, int*)>("eglInitialize");
  unsigned (*bind_api)(unsigned) = library.function<unsigned (*)(unsigned)>("eglBindAPI");
  Handle (*create_context)(Handle, Handle, Handle, const int*) =
      library.function<Handle (*)(Handle, Handle, Handle, const int*)>("eglCreateContext");
  unsigned (*destroy_context)(Handle,
                              Handle) = library.function<unsigned (*)(Handle, Handle)>("eglDestroyContext");
  unsigned (*make_current)(Handle, Handle, Handle, Handle) =
      library.function<unsigned (*)(Handle, Handle, Handle, Handle)>("eglMakeCurrent");
  int (*get_error)() = library.function<int (*)()>("eglGetError");
};

class EglContext final : public GlContext {
 public:
  EglContext() {
    const auto get_platform_display = reinterpret_cast<Handle (*)(unsigned, void*, const int*)>(
        api_.get_proc_address("eglGetPlatformDisplayEXT"));
    if (!get_platform_display) throw ContextError("EGL_EXT_platform_base is missing");
    display_ = get_platform_display(kPlatformSurfaceless, nullptr, nullptr);
    // The display belongs to the process and is never terminated: drivers crash when contexts outlive it.
    if (!display_ || api_.initialize(display_, nullptr, nullptr) != kTrue) fail("eglInitialize");
    if (api_.bind_api(kOpenGlApi) != kTrue) fail("eglBindAPI");
    constexpr std::array<int, 7> kAttributes = {kMajorVersion, 3,        kMinorVersion, 3,
                                                kProfileMask,  kCoreBit, kNone};
    context_ = api_.create_context(display_, nullptr, nullptr, kAttributes.data());
    if (!context_) fail("eglCreateContext");
    try {
      makeCurrent();
      load(api_.get_proc_address);
    } catch (const ContextError&) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }

  Backend backend() const override { return Backend::Egl; }
  void makeCurrent() override {
    if (api_.make_current(display_, nullptr, nullptr, context_) != kTrue) fail("eglMakeCurrent");
  }

 private:
  void release() {
    api_.make_current(display_, nullptr, nullptr, nullptr);
    api_.destroy_context(display_, context_);
  }
  [[noreturn]] void fail(const char* call) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", unsigned(api_.get_error()));
    throw ContextError(std::string(call) + " failed with EGL error " + code);
  }

  Egl api_;
  Handle display_ = nullptr;
  Handle context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> openEgl() { return std::make_unique<EglContext>(); }

}  // namespace viewer
