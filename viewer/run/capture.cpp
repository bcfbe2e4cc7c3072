// Offscreen pictures.
#include "viewer/run/capture.h"

#include "viewer/input_error.h"
#include "viewer/run/list_canvas.h"

namespace viewer {
namespace {

void addPositions(Trails& trails, const pfx::World& world) {
  if (trails.size() > kTrailSteps) trails.erase(trails.begin());
  trails.emplace_back();
  for (const pfx::RigidState& s : world.states()) trails.back().push_back(s.position);
}

}  // namespace

Capture::Capture(const CaptureSettings& settings)
    : settings_(settings),
      context_(makeContext({.backend = settings.backend})),
      renderer_(*context_, {.quality = settings.quality, .shader_dir = {}}) {}

Image Capture::draw(const SceneRun& run, const samples::CameraPose& camera, const Trails& trails) {
  // A fresh list each time: a picture must not depend on what was drawn before it.
  DrawList list;
  WorldView view(list);
  list.begin();
  list.camera = orbitCamera(camera);
  ViewExtras extras;
  extras.trails = &trails;
  const Camera& eye = list.camera;
  extras.probe = ProbeRay{eye.eye, 10.0f * (eye.target - eye.eye)};
  extras.body_colors = run.scene().bodyColors(run.world());
  view.add(run.world(), settings_.overlays, extras);
  ListCanvas canvas(list);
  run.scene().draw(run.world(), canvas);
  list.end();
  renderer_.draw({.width = settings_.width, .height = settings_.height}, list);
  return renderer_.readBack();
}

void Capture::render(const SceneSpec& scene, std::span<const int> frames,
                     const std::function<void(RenderedFrame&&)>& use) {
  SceneRun run(scene, settings_.run);
  Trails trails;
  for (int frame : frames) {
    if (settings_.overlays.trails)
      while (run.world().stepCount() < uint64_t(frame)) {
        run.step();
        addPositions(trails, run.world());
      }
    run.stepTo(uint64_t(frame));
    use({frame, run.stateHash(), draw(run, scene.camera, trails)});
  }
}

Backend requireBackend(const std::string& name) {
  if (const auto backend = parseBackend(name)) return *backend;
  throw InputError("unknown backend \"" + name + "\"; known: auto, osmesa, egl, glfw");
}

}  // namespace viewer
