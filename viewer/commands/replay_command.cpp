// vitrine replay: checks a recording against the scene, or draws one frame of it.
#include <cstdio>

#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/golden/golden_record.h"
#include "viewer/image/png.h"
#include "viewer/input_error.h"
#include "viewer/run/capture.h"
#include "viewer/run/progress.h"
#include "viewer/run/recording.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

struct Options {
  std::string file, out, size = "640x360", overlays, backend = "auto";
  std::optional<size_t> frame;
};

// Runs the scene again beside the recording; the first frame whose state differs ends it.
int check(const Recording& recording) {
  SceneRun run = startRun(recording);
  Progress progress("replay " + recording.head().target, recording.numFrames());
  for (size_t i = 0; i < recording.numFrames(); ++i) {
    progress.at(i);
    const RecordedFrame frame = recording.frame(i);
    stepTo(run, frame.step, recording.head().inputs);
    if (run.stateHash() == frame.state_hash) continue;
    std::printf("%s: diverges first in frame %zu: recorded state %s, now %s\n",
                recording.head().target.c_str(), i, hexText(frame.state_hash).c_str(),
                hexText(run.stateHash()).c_str());
    return 1;
  }
  std::printf("%s: all %zu frames are reproduced bit for bit\n", recording.head().target.c_str(),
              recording.numFrames());
  return 0;
}

int draw(const Recording& recording, const Options& options) {
  if (options.out.empty()) throw InputError("--frame needs --out PNG");
  if (*options.frame >= recording.numFrames())
    throw InputError("--frame " + std::to_string(*options.frame) + ": " + options.file + " has frames 0 .. " +
                     std::to_string(recording.numFrames() - 1));
  const PixelSize size = parseSize(options.size);
  const CaptureSettings settings{.backend = requireBackend(options.backend),
                                 .width = size.width,
                                 .height = size.height,
                                 .overlays = parseOverlays(options.overlays)};
  SceneRun run = startRun(recording);
  const RecordedFrame frame = recording.frame(*options.frame);
  // What a scene simulates besides the world is only there when it is run again.
  stepTo(run, frame.step, recording.head().inputs);
  if (run.stateHash() != frame.state_hash) {
    std::fprintf(stderr, "vitrine replay: the scene runs differently now; the picture shows the recorded poses\n");
    applyFrame(run.world(), frame);
  }
  Capture capture(settings);
  writePng(options.out, capture.draw(run, run.spec().camera));
  std::printf("%s\n", options.out.c_str());
  return 0;
}

int replay(const Options& options) {
  const Recording recording = Recording::read(options.file);
  return options.frame ? draw(recording, options) : check(recording);
}

}  // namespace

void addReplayCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "replay",
      "Check that a recording is reproduced bit for bit, or draw one of its frames (--frame, --out)");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "Recording")->required();
  command->add_option("--frame", options->frame, "Frame to draw, from 0");
  command->add_option("--out", options->out, "PNG to write");
  command->add_option("--size", options->size, "Size in px")->capture_default_str();
  command->add_option("--overlay", options->overlays, "What to draw on top: " + overlayNames());
  command->add_option("--backend", options->backend, "auto, osmesa, egl or glfw")->capture_default_str();
  command->callback([&action, options] { action = [options] { return replay(*options); }; });
}

}  // namespace viewer
