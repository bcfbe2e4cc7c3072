// OSMesa: Mesa's software rasterizer as a plain library, without a window system. Left Mesa with
// version 25.1.
#include <array>
#include <cstdint>

#include "viewer/context/backends.h"
#include "viewer/context/library.h"

namespace viewer {

namespace {

// The part of GL/osmesa.h that is used, declared here so that the program builds without it.
using OsMesaHandle = struct OsMesaObject*;
constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34, kMajorVersion = 0x36,
              kMinorVersion = 0x37, kRgba = 0x1908;
constexpr unsigned kUnsignedByte = 0x1401;

struct OsMesa {
  Library library{{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}};
  OsMesaHandle (*create)(const int*, OsMesaHandle) =
      library.function<OsMesaHandle (*)(const int*, OsMesaHandle)>("OSMesaCreateContextAttribs");
  void (*destroy)(OsMesaHandle) = library.function<void (*)(OsMesaHandle)>("OSMesaDestroyContext");
  uint8_t (*make_current)(OsMesaHandle, void*, unsigned, int, int) =
      library.function<uint8_t (*)(OsMesaHandle, void*, unsigned, int, int)>("OSMesaMakeCurrent");
  void (*(*get_proc_address)(const char*))() =
      library.function<void (*(*)(const char*))()>("OSMesaGetProcAddress");
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() {
    constexpr std::array<int, 11> kAttributes = {
        kFormat, kRgba, kDepthBits, 0, kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3, 0};
    handle_ = api_.create(kAttributes.data(), nullptr);
    if (!handle_) throw ContextError("OSMesaCreateContextAttribs failed for OpenGL 3.3 core");
    try {
      makeCurrent();
      load(api_.get_proc_address);
    } catch (const ContextError&) {
      api_.destroy(handle_);
      throw;
    }
  }
  ~OsMesaContext() override { api_.destroy(handle_); }

  Backend backend() const override { return Backend::OsMesa; }
  void makeCurrent() override {
    if (!api_.make_current(handle_, buffer_.data(), kUnsignedByte, kSide, kSide))
      throw ContextError("OSMesaMakeCurrent failed");
  }

 private:
  // Renderers have framebuffers of their own; this one only has to exist.
  static constexpr int kSide = 16;
  OsMesa api_;
  OsMesaHandle handle_ = nullptr;
  std::array<uint32_t, kSide * kSide> buffer_{};
};

}  // namespace

std::unique_ptr<GlContext> openOsMesa() { return std::make_unique<OsMesaContext>(); }

}  // namespace viewer
