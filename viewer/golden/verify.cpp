// The golden test: draw, compare, sort out what changed.
#include "viewer/golden/verify.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include "viewer/file.h"
#include "viewer/image/png.h"
#include "viewer/input_error.h"

namespace viewer {
namespace fs = std::filesystem;
namespace {

Triage findTriage(const FrameResult& r) {
  if (!sameCamera(r.golden.camera, r.actual.camera)) return Triage::CameraChange;
  const bool state_same = r.golden.state_hash == r.actual.state_hash;
  if (r.verdict.pass) return state_same ? Triage::None : Triage::HiddenPhysics;
  return state_same ? Triage::RendererChange : Triage::PhysicsChange;
}

void addDifferencePictures(FrameResult& r, const Image& expected, const Image& actual) {
  if (!expected.sameSize(actual)) return;
  if (!r.verdict.flip) r.verdict.flip = measureFlip(expected, actual);
  r.difference_png = encodePng(differenceImage(expected, actual));
  r.heat_png = encodePng(heatImage(actual.width, actual.height, r.verdict.flip->map));
  r.verdict.flip->map = {};  // the picture holds it now
}

void compareWithGolden(FrameResult& r, const Image& actual, const VerifySettings& settings) {
  Image expected;
  try {
    r.golden = readRecord(framePath(settings.golden_dir, r.target, r.frame, ".json"));
    const fs::path picture = framePath(settings.golden_dir, r.target, r.frame, ".png");
    r.expected_png = readFile(picture);
    expected = decodePng(r.expected_png, picture.string());
    if (imageHash(expected) != r.golden.image_hash)
      throw InputError(picture.string() + ": is not the picture that its record describes");
  } catch (const InputError& error) {
    r.triage = Triage::DamagedGolden, r.why = error.what();
    return;
  }
  r.same_rasteriser = r.golden.renderer == r.actual.renderer;
  const Limits limits = r.golden.tolerance ? r.golden.tolerance->limits : Limits{};
  r.verdict = judge(expected, actual, r.same_rasteriser ? Rasteriser::Same : Rasteriser::Other, limits);
  if (r.verdict.exact)
    r.actual_png = r.expected_png;
  else
    addDifferencePictures(r, expected, actual);
  r.triage = findTriage(r);
  r.pass = r.triage == Triage::None;
  r.why = r.verdict.why;
  if (r.triage == Triage::HiddenPhysics)
    r.why = "state hash is " + hexText(r.actual.state_hash) + ", golden has " + hexText(r.golden.state_hash);
  if (!r.same_rasteriser && settings.strict_renderer) {
    r.pass = false;
    r.triage = r.triage == Triage::None ? Triage::RendererChange : r.triage;
    r.why = "rasteriser is \"" + r.actual.renderer + "\", golden was drawn by \"" + r.golden.renderer + "\"";
  }
}

FrameResult judgeFrame(const SceneSpec& scene, RenderedFrame&& frame, const std::string& renderer,
                       const VerifySettings& settings) {
  FrameResult r;
  r.target = scene.target(), r.frame = frame.frame;
  r.actual = {.target = r.target,
              .frame = frame.frame,
              .substeps = scene.world.substeps,
              .width = frame.image.width,
              .height = frame.image.height,
              .state_hash = frame.state_hash,
              .image_hash = imageHash(frame.image),
              .camera = scene.camera,
              .renderer = renderer,
              .tolerance = {}};
  const bool no_picture = !fs::exists(framePath(settings.golden_dir, r.target, r.frame, ".png"));
  const bool no_record = !fs::exists(framePath(settings.golden_dir, r.target, r.frame, ".json"));
  if (no_picture && no_record)
    r.triage = Triage::NewFrame, r.why = "no golden image yet; accept with --approve --reason TEXT";
  else
    compareWithGolden(r, frame.image, settings);
  if (r.actual_png.empty()) r.actual_png = encodePng(frame.image);
  return r;
}

// Draws scenes until none is left; several threads share one queue. The last ones of the list come first: those are the
// large ones, and a long scene at the end would leave the other threads without work.
class Queue {
 public:
  Queue(std::span<const SceneSpec> scenes, const VerifySettings& settings, const VerifyProgress& progress)
      : scenes_(scenes), settings_(settings), progress_(progress), results_(scenes.size()) {
    for (const SceneSpec& s : scenes) total_ += s.frames.size();
  }

  void work(FrameSource& source) {
    for (size_t taken = next_++; taken < scenes_.size(); taken = next_++) {
      const size_t i = scenes_.size() - 1 - taken;
      const SceneSpec& scene = scenes_[i];
      try {
        source.render(scene, scene.frames, [&](RenderedFrame&& frame) {
          add(i, judgeFrame(scene, std::move(frame), source.fingerprint(), settings_));
        });
      } catch (const std::exception& error) {
        addMissing(i, error.what());
      }
    }
  }

  std::vector<FrameResult> take() {
    std::vector<FrameResult> all;
    for (auto& of_scene : results_) std::move(of_scene.begin(), of_scene.end(), std::back_inserter(all));
    return all;
  }

 private:
  void add(size_t scene, FrameResult&& result) {
    const std::lock_guard lock(mutex_);
    results_[scene].push_back(std::move(result));
    if (progress_) progress_(results_[scene].back(), ++done_, total_);
  }

  // Frames that were not drawn because the scene failed.
  void addMissing(size_t scene, const std::string& why) {
    const SceneSpec& spec = scenes_[scene];
    for (size_t k = results_[scene].size(); k < spec.frames.size(); ++k) {
      FrameResult r;
      r.target = spec.target(), r.frame = spec.frames[k], r.triage = Triage::SceneError, r.why = why;
      add(scene, std::move(r));
    }
  }

  std::span<const SceneSpec> scenes_;
  const VerifySettings& settings_;
  const VerifyProgress& progress_;
  std::vector<std::vector<FrameResult>> results_;  // of each scene; only its worker writes
  std::atomic<size_t> next_ = 0;
  std::mutex mutex_;
  size_t done_ = 0, total_ = 0;
};

std::vector<FrameResult> findStale(std::span<const SceneSpec> scenes, const fs::path& golden_dir) {
  std::set<fs::path> wanted;
  for (const SceneSpec& s : scenes)
    for (int frame : s.frames) wanted.insert(framePath("", s.target(), frame, ""));
  std::set<fs::path> stale;
  for (const auto& sample : fs::directory_iterator(golden_dir)) {
    if (!sample.is_directory()) continue;
    for (const auto& file : fs::directory_iterator(sample)) {
      const fs::path extension = file.path().extension();
      const fs::path name = sample.path().filename() / file.path().stem();
      if ((extension == ".png" || extension == ".json") && !wanted.contains(name)) stale.insert(name);
    }
  }
  std::vector<FrameResult> out;
  for (const fs::path& name : stale) {
    FrameResult r;
    const std::string text = name.string();
    const size_t bar = text.rfind('_');
    const std::string number = bar == text.npos ? "" : text.substr(bar + 1);
    // Only names of the form SCENE_FRAME are golden images; other pictures may live in the folder.
    if (number.empty() || number.size() > 9 || number.find_first_not_of("0123456789") != number.npos)
      continue;
    r.target = text.substr(0, bar), r.frame = std::stoi(number);
    r.triage = Triage::StaleGolden, r.why = "no scene draws this golden image; --approve removes it";
    out.push_back(std::move(r));
  }
  return out;
}

}  // namespace

std::string_view toText(Triage triage) {
  switch (triage) {
    case Triage::None:
      return "unchanged";
    case Triage::PhysicsChange:
      return "physics change";
    case Triage::RendererChange:
      return "renderer change";
    case Triage::HiddenPhysics:
      return "physics change that the picture does not show";
    case Triage::CameraChange:
      return "camera change";
    case Triage::NewFrame:
      return "new frame";
    case Triage::DamagedGolden:
      return "damaged golden image";
    case Triage::StaleGolden:
      return "stale golden image";
    case Triage::SceneError:
      return "scene failed";
  }
  return "";
}

std::vector<FrameResult> verifyScenes(std::span<const SceneSpec> scenes, const VerifySettings& settings,
                                      const FrameSourceFactory& make_source, const VerifyProgress& progress) {
  Queue queue(scenes, settings, progress);
  // The first source is made before any thread: opening a context cleans the environment of the process.
  const std::unique_ptr<FrameSource> own = make_source();
  const int helpers = std::min(settings.workers, int(scenes.size())) - 1;
  std::vector<std::jthread> threads;
  for (int i = 0; i < helpers; ++i)
    threads.emplace_back([&] {
      // A helper without a source leaves its share to the others.
      try {
        queue.work(*make_source());
      } catch (const std::exception&) {
      }
    });
  queue.work(*own);
  threads.clear();
  std::vector<FrameResult> results = queue.take();
  if (settings.find_stale && fs::is_directory(settings.golden_dir))
    for (FrameResult& r : findStale(scenes, settings.golden_dir)) results.push_back(std::move(r));
  return results;
}

std::vector<SceneSpec> shard(std::span<const SceneSpec> scenes, int index, int count) {
  std::vector<SceneSpec> part;
  for (size_t i = size_t(index - 1); i < scenes.size(); i += size_t(count)) part.push_back(scenes[i]);
  return part;
}

}  // namespace viewer
