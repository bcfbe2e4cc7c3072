// Offscreen pictures of a world: a GL context, a renderer and a draw list that live together.
#pragma once

#include <memory>
#include <string>

#include "viewer/context/gl_context.h"
#include "viewer/draw_list/draw_list.h"
#include "viewer/render/renderer.h"
#include "viewer/run/frame_source.h"
#include "viewer/run/overlays.h"
#include "viewer/run/scene_run.h"
#include "viewer/run/world_view.h"

namespace viewer {

struct CaptureSettings {
  Backend backend = Backend::Auto;
  int width = 640, height = 360;  // px
  Overlays overlays = {};
  Quality quality = Quality::Ci;
  RunSettings run = {};  // of the scenes that render() runs
};

// Belongs to the thread that made it.
class Capture : public FrameSource {
 public:
  // Throws ContextError when no backend can be opened.
  explicit Capture(const CaptureSettings& settings);

  // The scene as it is now, with the trails of the steps before it.
  Image draw(const SceneRun& run, const samples::CameraPose& camera, const Trails& trails = {});

  std::string fingerprint() const override { return renderer_.fingerprint(); }
  void render(const SceneSpec& scene, std::span<const int> frames,
              const std::function<void(RenderedFrame&&)>& use) override;

 private:
  CaptureSettings settings_;
  std::unique_ptr<GlContext> context_;
  Renderer renderer_;
};

// The backend of that name. Throws InputError that lists the known ones.
Backend requireBackend(const std::string& name);

}  // namespace viewer
