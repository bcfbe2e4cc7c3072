// vitrine record: runs a scene and writes every frame to a file.
#include <cstdio>

#include "viewer/commands/commands.h"
#include "viewer/file.h"
#include "viewer/golden/golden_record.h"
#include "viewer/input_error.h"
#include "viewer/run/progress.h"
#include "viewer/run/recording.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

struct Options {
  std::string target, out;
  int steps = 600;
  RunSettings run;
};

int record(const Options& options) {
  const SceneSpec scene = findScene(allScenes(), options.target);
  const auto folder = std::filesystem::path(options.out).parent_path();
  requireWritableFolder(folder.empty() ? "." : folder);
  SceneRun run(scene, options.run);
  RecordingWriter writer(
      {.target = run.spec().target(), .dt = options.run.dt, .substeps = uint32_t(run.world().def().substeps)});
  writer.add(captureFrame(run));
  Progress progress("record " + run.spec().target(), uint64_t(options.steps));
  for (int i = 0; i < options.steps; ++i) {
    progress.at(uint64_t(i));
    run.step();
    writer.add(captureFrame(run));
  }
  const std::vector<uint8_t> bytes = writer.bytes();
  writeFile(options.out, bytes);
  std::printf("%s: %zu frames, %zu bytes, last state %s\n", options.out.c_str(), writer.numFrames(),
              bytes.size(), hexText(run.stateHash()).c_str());
  return 0;
}

}  // namespace

void addRecordCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("record", "Run a scene and write every frame to a file");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->target, "SAMPLE/SCENE")->required();
  command->add_option("--steps", options->steps, "Steps to run")->check(CLI::Range(0, 1000000))->required();
  command->add_option("--out", options->out, "File to write")->required();
  command->add_option("--substeps", options->run.substeps, "Solver sub-steps a step")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options->run.threads, "Threads")->check(CLI::Range(1, 64));
  command->callback([&action, options] { action = [options] { return record(*options); }; });
}

}  // namespace viewer
