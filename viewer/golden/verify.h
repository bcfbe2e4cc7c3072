// Draws scenes and judges every frame against its golden image and its golden state.
//
// Two questions are asked of every frame and answered apart: is the state of the world the same, bit for bit,
// and does the picture look the same? Together they tell what changed (see Triage).
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "viewer/golden/golden_record.h"
#include "viewer/image/verdict.h"
#include "viewer/run/frame_source.h"

namespace viewer {

enum class Triage {
  None,            // state and picture hold
  PhysicsChange,   // state and picture differ
  RendererChange,  // the state is the same, the picture differs
  HiddenPhysics,   // the state differs and the picture does not show it
  CameraChange,    // the scene is looked at from elsewhere
  NewFrame,        // there is no golden image yet
  DamagedGolden,   // the golden image or its record cannot be used
  StaleGolden,     // no scene draws this golden image any more
  SceneError,      // the scene or the renderer failed
};
std::string_view toText(Triage triage);

struct FrameResult {
  std::string target;  // "2_stable/tower"
  int frame = 0;
  bool pass = false;
  Triage triage = Triage::None;
  std::string why;  // one line
  Verdict verdict;  // of the picture, when there were two to compare
  bool same_rasteriser = true;
  GoldenRecord golden, actual;  // golden: as far as it could be read
  std::vector<uint8_t> expected_png, actual_png, difference_png,
      heat_png;  // files; the last two unless exact

  std::string name() const { return target + "_" + std::to_string(frame); }
};

struct VerifySettings {
  std::filesystem::path golden_dir;
  bool strict_renderer = false;  // another rasteriser than the golden's is a failure
  int workers = 1;               // threads that draw, each with a source of its own
  bool find_stale = false;       // `scenes` are all there are: a golden image of another scene is stale
};

// Called as frames are done, from one thread at a time.
using VerifyProgress = std::function<void(const FrameResult& result, size_t done, size_t total)>;

// One result a frame, in the order of scenes and frames, stale ones last.
std::vector<FrameResult> verifyScenes(std::span<const SceneSpec> scenes, const VerifySettings& settings,
                                      const FrameSourceFactory& make_source, const VerifyProgress& progress);

// The scenes of part `index` (1 .. count) of a suite that is split over several machines.
std::vector<SceneSpec> shard(std::span<const SceneSpec> scenes, int index, int count);

}  // namespace viewer
