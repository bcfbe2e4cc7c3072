// vitrine verify: the golden-image test.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/file.h"
#include "viewer/golden/approve.h"
#include "viewer/golden/junit.h"
#include "viewer/golden/report.h"
#include "viewer/golden/verify.h"
#include "viewer/input_error.h"
#include "viewer/run/capture.h"

namespace viewer {
namespace fs = std::filesystem;
namespace {

struct Options {
  std::vector<std::string> targets;
  std::string golden, report, reason, shard = "1/1", junit, size = "640x360", backend = "auto";
  bool approve = false, strict_renderer = false;
  int workers = 0;  // 0: as many as the machine has, at most kMaxWorkers
};

// More draw threads than this gain nothing: scenes are few and each has a renderer to build.
constexpr int kMaxWorkers = 8;

// The build tree that the program lies in, when it lies in one.
fs::path buildTree() {
  const fs::path tree = programFolder().parent_path();
  return fs::exists(tree / "CMakeCache.txt") ? tree : fs::path();
}

// --golden, or screenshots here, or that of the source tree two floors above build/PRESET.
fs::path goldenFolder(const Options& options) {
  if (options.golden.empty()) {
    if (fs::is_directory("screenshots")) return "screenshots";
    const fs::path tree = buildTree();
    if (!tree.empty()) return tree.parent_path().parent_path() / "screenshots";
  }
  const fs::path folder = options.golden.empty() ? "screenshots" : options.golden;
  if (!options.approve && !fs::is_directory(folder))
    throw InputError(folder.string() + ": no such folder of golden images; name one with --golden DIR");
  return folder;
}

fs::path reportFolder(const Options& options) {
  if (!options.report.empty()) return options.report;
  const fs::path tree = buildTree();
  return (tree.empty() ? fs::path(".") : tree) / "golden-report";
}

std::vector<SceneSpec> chooseScenes(const Options& options) {
  const std::vector<SceneSpec> all = allScenes();
  if (options.targets.empty()) return all;
  std::vector<SceneSpec> chosen;
  for (const std::string& target : options.targets)
    for (SceneSpec& s : findTarget(all, target)) {
      const auto same = [&](const SceneSpec& known) { return known.target() == s.target(); };
      if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back(std::move(s));
    }
  return chosen;
}

void printProgress(const FrameResult& r, size_t done, size_t total) {
  std::fprintf(stderr, "[%zu/%zu] %s%s%s\n", done, total, r.name().c_str(), r.pass ? "" : ": ",
               r.pass ? "" : std::string(toText(r.triage)).c_str());
}

// What a reader of the log needs: failures by kind, the rasteriser rule, where the report is.
int summarize(std::span<const FrameResult> results, const fs::path& report, double seconds) {
  const auto count = [&](auto test) { return size_t(std::count_if(results.begin(), results.end(), test)); };
  const size_t failed = count([](const FrameResult& r) { return !r.pass; });
  const size_t other = count([](const FrameResult& r) { return !r.same_rasteriser; });
  for (size_t i : worstFirst(results))
    if (!results[i].pass)
      std::printf("FAIL %s: %s: %s\n", results[i].name().c_str(),
                  std::string(toText(results[i].triage)).c_str(), results[i].why.c_str());
  if (other > 0)
    std::printf("%zu golden images were drawn by another rasteriser; the looser rule decided about them\n",
                other);
  std::printf("%zu passed (%zu pixel for pixel), %zu failed in %.1f s; report: %s\n", results.size() - failed,
              count([](const FrameResult& r) { return r.pass && r.verdict.exact; }), failed, seconds,
              report.c_str());
  return failed == 0 ? 0 : 1;
}

int acceptResults(std::span<const FrameResult> results, const fs::path& golden, const std::string& reason) {
  const Approval approval = approve(results, golden, reason);
  for (const std::string& name : approval.written) std::printf("accepted %s\n", name.c_str());
  for (const std::string& name : approval.removed) std::printf("removed %s\n", name.c_str());
  std::printf("%zu accepted, %zu removed in %s\n", approval.written.size(), approval.removed.size(),
              golden.c_str());
  const auto broken = [](const FrameResult& r) { return r.triage == Triage::SceneError; };
  for (const FrameResult& r : results)
    if (broken(r)) std::printf("FAIL %s: %s\n", r.name().c_str(), r.why.c_str());
  return std::any_of(results.begin(), results.end(), broken) ? 1 : 0;
}

// Threads that draw. Windows may only be made on the main thread. When several draw, the software rasteriser
// works on each of them alone: its own threads would only get in the way.
int chooseWorkers(const Options& options, Backend backend) {
  if (backend == Backend::Glfw) return 1;
  const int cores = std::clamp(int(std::thread::hardware_concurrency()), 1, kMaxWorkers);
  const int workers = options.workers > 0 ? options.workers : cores;
  constexpr int kKeepWhatTheUserSet = 0;
  if (workers > 1) setenv("LP_NUM_THREADS", "0", kKeepWhatTheUserSet);
  return workers;
}

int verify(const Options& options) {
  if (options.approve && options.reason.empty()) throw InputError("--approve needs --reason TEXT");
  const PixelSize size = parseSize(options.size);
  const ShardChoice part = parseShard(options.shard);
  const std::vector<SceneSpec> scenes = shard(chooseScenes(options), part.index, part.count);
  const Backend backend = requireBackend(options.backend);
  const VerifySettings settings{.golden_dir = goldenFolder(options),
                                .strict_renderer = options.strict_renderer,
                                .workers = chooseWorkers(options, backend),
                                .find_stale = options.targets.empty() && part.count == 1};
  const CaptureSettings capture{.backend = backend, .width = size.width, .height = size.height};
  const fs::path report = reportFolder(options);
  requireWritableFolder(report);

  const auto start = std::chrono::steady_clock::now();
  const std::vector<FrameResult> results = verifyScenes(
      scenes, settings, [&] { return std::make_unique<Capture>(capture); }, printProgress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string renderer = results.empty() ? "" : results.front().actual.renderer;
  const fs::path page = writeReport(report, results, {.renderer = renderer, .seconds = seconds});
  if (!options.junit.empty()) writeText(options.junit, junitXml(results, seconds));
  if (options.approve) return acceptResults(results, settings.golden_dir, options.reason);
  return summarize(results, page, seconds);
}

}  // namespace

void addVerifyCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("verify", "Draw scenes and compare them with the golden images");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->targets, "SAMPLE[/SCENE]; none: all");
  command->add_option("--golden", options->golden, "Folder of golden images; default: screenshots");
  command->add_option("--report", options->report,
                      "Folder for the HTML report; default: golden-report in the build tree");
  command->add_flag("--approve", options->approve,
                    "Accept what differs as the new golden images; needs --reason");
  command->add_option("--reason", options->reason,
                      "Why, for --approve; logged in APPROVALS.md beside the images");
  command->add_option("--shard", options->shard, "Only part I of N of the scenes, for example 1/3");
  command->add_option("--junit", options->junit, "Write a JUnit file");
  command->add_option("--size", options->size, "Size in px")->capture_default_str();
  command->add_option("--backend", options->backend, "auto, osmesa, egl or glfw")->capture_default_str();
  command->add_option("--workers", options->workers, "Threads that draw; default: one a core")
      ->check(CLI::Range(1, 64));
  command->add_flag("--strict-renderer", options->strict_renderer,
                    "Fail when another rasteriser drew the golden images");
  command->callback([&action, options] { action = [options] { return verify(*options); }; });
}

}  // namespace viewer
