// vitrine render: images of scenes.
#include <cstdio>

#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/file.h"
#include "viewer/golden/golden_record.h"
#include "viewer/image/png.h"
#include "viewer/run/capture.h"

namespace viewer {
namespace {

struct Options {
  std::string target, frames, size = "640x360", overlays, camera, backend = "auto", quality = "ci", out;
};

Quality qualityOf(const std::string& name) {
  return name == "hero" ? Quality::Hero : name == "window" ? Quality::Window : Quality::Ci;
}

int render(const Options& options) {
  const PixelSize size = parseSize(options.size);
  CaptureSettings settings{.backend = requireBackend(options.backend),
                           .width = size.width,
                           .height = size.height,
                           .overlays = parseOverlays(options.overlays),
                           .quality = qualityOf(options.quality)};
  std::vector<SceneSpec> scenes = findTarget(allScenes(), options.target);
  size_t total = 0;
  for (SceneSpec& s : scenes) {
    if (!options.frames.empty()) s.frames = parseFrames(options.frames);
    s.camera = parseCamera(options.camera, s.camera);
    total += s.frames.size();
  }
  requireWritableFolder(options.out);
  Capture capture(settings);
  size_t done = 0;
  for (const SceneSpec& s : scenes)
    capture.render(s, s.frames, [&](RenderedFrame&& frame) {
      const std::filesystem::path file = framePath(options.out, s.target(), frame.frame, ".png");
      writePng(file, frame.image);
      std::printf("%s\n", file.c_str());
      std::fprintf(stderr, "[%zu/%zu] %s frame %d\n", ++done, total, s.target().c_str(), frame.frame);
    });
  return 0;
}

}  // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Write images SAMPLE/SCENE_FRAME.png of scenes");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->target, "SAMPLE[/SCENE]")->required();
  command->add_option("--frames", options->frames,
                      "Steps before each picture, for example 0,60,120; default: the scene's");
  command->add_option("--size", options->size, "Size in px")->capture_default_str();
  command->add_option("--overlay", options->overlays, "What to draw on top, a list of: " + overlayNames());
  command->add_option("--camera", options->camera,
                      "For example yaw=30,pitch=20,distance=12,target=0/1/0 (degrees, m)");
  command->add_option("--backend", options->backend, "auto, osmesa, egl or glfw")->capture_default_str();
  command->add_option("--quality", options->quality, "ci, window or hero")
      ->check(CLI::IsMember({"ci", "window", "hero"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder to write into")->required();
  command->callback([&action, options] { action = [options] { return render(*options); }; });
}

}  // namespace viewer
