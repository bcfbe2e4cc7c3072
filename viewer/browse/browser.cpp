#include "viewer/browse/browser.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

#include "viewer/browse/ui_style.h"
#include "viewer/file.h"
#include "viewer/image/png.h"
#include "viewer/input_error.h"
#include "viewer/run/list_canvas.h"

namespace viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr Color kSelectedColor = 0xffd9480fu, kHoverColor = 0xff7a5a3au;
constexpr double kFrameTime = 1.0 / 60.0;  // s, of a picture; faster is a waste of the processor

std::unique_ptr<Window> open(const BrowseSettings& settings, const std::string& target) {
  try {
    return openWindow(
        {.width = settings.width, .height = settings.height, .title = "Vitrine", .visible = true});
  } catch (const ContextError& error) {
    throw InputError(std::string("there is no display to open a window on (") + error.what() +
                     "); draw without one: vitrine render " + target + " --out pictures");
  }
}

bool isRecordingFile(const std::string& target) { return std::filesystem::path(target).extension() == ".rec"; }

// Where there is a graphics processor four samples a pixel cost nothing.
Quality qualityFor(GlContext& context) {
  const std::string rasterizer = Renderer::rasterizer(context);
  const bool software =
      rasterizer.find("llvmpipe") != std::string::npos || rasterizer.find("softpipe") != std::string::npos;
  return software ? Quality::Window : Quality::Ci;
}

}  // namespace

Browser::Browser(const BrowseOptions& options)
    : options_(options), scenes_(allScenes()), settings_(readSettings(settingsFile())) {
  if (scenes_.empty()) throw InputError("there are no scenes to show");
  const auto known = [&](const std::string& target) {
    return std::any_of(scenes_.begin(), scenes_.end(),
                       [&](const SceneSpec& s) { return s.target() == target; });
  };
  std::string target = known(settings_.target) ? settings_.target : scenes_.front().target();
  const bool recorded = isRecordingFile(options.target);
  if (!options.target.empty() && !recorded) target = findTarget(scenes_, options.target).front().target();
  window_ = open(settings_, target);
  ImGui::GetIO().IniFilename = nullptr;
  setKeyMap(ImGui::GetIO());
  setUiStyle(std::max(1.0f, window_->poll().scale));
  renderer_ = std::make_unique<Renderer>(
      *window_,
      RenderParams{.quality = qualityFor(*window_), .wire = false, .shader_dir = options.shader_dir});
  session_.speed = settings_.speed;
  recorded ? openRecording(options.target) : load(target);
}

void Browser::load(const std::string& target) {
  const auto spec =
      std::find_if(scenes_.begin(), scenes_.end(), [&](const SceneSpec& s) { return s.target() == target; });
  if (spec == scenes_.end()) return;
  try {
    session_.settings = {.threads = session_.settings.threads};
    session_.load(*spec);
  } catch (const std::exception& error) {
    say(target + ": " + error.what());
    return;
  }
  settings_.target = target;
  showScene();
  session_.paused = false;
}

void Browser::openRecording(const std::string& file) {
  session_.open(Recording::read(file));
  showScene();
  session_.paused = true;
  say(std::to_string(session_.lastStep() - session_.firstStep() + 1) + " recorded steps of " +
      session_.spec().target());
}

void Browser::showScene() {
  camera_ = {.pose = session_.spec().camera, .orthographic = false};
  selected_ = {};
  follow_ = false;
  controls_ = {};
  view_ = std::make_unique<WorldView>(list_);
}

void Browser::restart() {
  try {
    session_.restart();
  } catch (const std::exception& error) {
    say(error.what());
  }
  view_ = std::make_unique<WorldView>(list_);
}

std::string Browser::title() const {
  const std::string selected = titleOf(session_.world(), selected_);
  return session_.spec().target() + " - step " + std::to_string(session_.step()) +
         (session_.paused ? " - paused" : "") + (session_.isReplay() ? " - replay" : "") +
         (session_.divergence() ? " - diverged at " + std::to_string(*session_.divergence()) : "") +
         (session_.isRecording() ? " - recording" : "") + (selected.empty() ? "" : " - " + selected) + " - Vitrine";
}

void Browser::record() {
  list_.begin();
  selected_ = stillThere(session_.world(), selected_);
  if (const pfx::Aabb box = boundsOf(session_.world(), selected_); follow_ && box.min.x() <= box.max.x())
    camera_.pose.target = box.center();
  list_.camera = camera_.camera();
  ViewExtras extras;
  if (settings_.overlays.selection_only) extras.selected = selectedBodies();
  const Trails trails = settings_.overlays.trails ? recentTrails() : Trails();
  extras.trails = &trails;
  if (!ImGui::GetIO().WantCaptureMouse && mouse_x_ >= 0.0f) {
    const Ray ray = mouseRay(mouse_x_, mouse_y_);
    extras.probe = ProbeRay{ray.origin, ray.direction};
  }
  extras.body_colors = session_.scene().bodyColors(session_.world());
  view_->add(session_.world(), settings_.overlays, extras);
  if (selected_.kind == PickKind::Triangle)
    view_->addTriangle(session_.world(), selected_.body.index, selected_.facet, kSelectedColor);
  addHovered();
  ListCanvas canvas(list_);
  session_.scene().draw(session_.world(), canvas);
  if (const auto& grab = session_.grab; grab && session_.world().isValid(grab->body)) {
    const pfx::Vec3 held = session_.world().states()[grab->body.index].pose().apply(grab->local);
    list_.add(Line{held, grab->target, 0xffd9480fu, 2.5f, 0});
    list_.add(Point{held, 0xffd9480fu, 9.0f, 0});
  }
  list_.scale_bar = !settings_.show_ui;
  list_.end();
}

std::vector<uint8_t> Browser::selectedBodies() const {
  if (selected_.kind == PickKind::Nothing) return {};
  std::vector<uint8_t> selected(session_.world().states().size(), 0);
  for (uint32_t body : bodiesOf(session_.world(), selected_)) selected[body] = 1;
  return selected;
}

Trails Browser::recentTrails() const {
  Trails trails;
  for (uint64_t step = session_.step() > kTrailSteps ? session_.step() - kTrailSteps : 0; step <= session_.step();
       ++step)
    if (const RecordedFrame* frame = session_.remembered(step)) {
      trails.emplace_back();
      for (const RecordedBody& body : frame->bodies) trails.back().push_back(body.position);
    }
  return trails;
}

// The triangle of a large mesh under the mouse, with its numbers beside it.
void Browser::addHovered() {
  if (ImGui::GetIO().WantCaptureMouse || drag_ != DragMode::None || mouse_x_ < 0.0f) return;
  const Ray ray = mouseRay(mouse_x_, mouse_y_);
  const pfx::RayOutput hit = session_.world().castRay({.start = ray.origin, .direction = ray.direction});
  if (!hit.hit || !meshOfBody(session_.world(), hit.body)) return;
  view_->addTriangle(session_.world(), hit.body, hit.triangle, kHoverColor);
  list_.add(Label{.position = pfx::Vec3(mouse_x_ + 16.0f, mouse_y_ + 14.0f, 0.0f),
                  .text = "triangle " + std::to_string(hit.triangle) + ", island " + std::to_string(hit.island) +
                          " of " + bodyTitle(session_.world(), hit.body),
                  .on_screen = true});
}

FrameInput Browser::frameInput() const {
  return {.width = width_,
          .height = height_,
          .ui = nullptr,
          .selected = pickOf(session_.world(), selected_),
          .label_scale = 1.0f,
          .covered_right = covered_right_};
}

void Browser::layOutSide(const PanelArea& area) {
  SideState state{&settings_.overlays, selected_};
  if (selected_.kind == PickKind::Triangle) {
    const pfx::LargeMesh& mesh = *meshOfBody(session_.world(), selected_.body.index)->mesh;
    const uint32_t island = pfx::islandOf(mesh, selected_.facet);
    state.marked = view_->markOf({selected_.body.index, island, selected_.facet - mesh.islands[island].first_facet});
  }
  state.show = std::exchange(show_tab_, SideTab::Same);
  const SideEdit edit = sidePanel(area, session_, state);
  for (const SceneInput& input : edit.inputs) session_.give(input);
  if (edit.restart) restart();
  if (edit.inspector.mark) view_->mark(session_.world(), edit.inspector.mark->triangle, edit.inspector.mark->what);
  if (edit.inspector.selected) select(*edit.inspector.selected);
  if (edit.inspector.command) execute(*edit.inspector.command);
}

void Browser::select(const Selection& selection) {
  selected_ = selection;
  if (selection.kind != PickKind::Nothing) show_tab_ = SideTab::Selection;
}

void Browser::layOutPanels() {
  selected_ = stillThere(session_.world(), selected_);
  const float w = float(width_), h = float(height_), unit = ImGui::GetFontSize(), gap = 0.6f * unit;
  covered_right_ = 0.0f;
  if (settings_.show_ui) {
    const float bar = 2.7f * unit, left = 15.0f * unit, right = 23.0f * unit,
                drawer = settings_.show_costs ? 16.0f * unit : 0.0f;
    const float sides = h - bar - 3.0f * gap - (drawer > 0.0f ? drawer + gap : 0.0f);
    if (const auto target =
            sceneListPanel({gap, gap, left, sides}, scenes_, session_.spec().target(), list_state_))
      requestLoad(*target);
    layOutSide({w - right - gap, gap, right, sides});
    covered_right_ = right + gap;
    const TransportEdit transport = transportPanel({gap, h - bar - gap, w - 2.0f * gap, bar}, session_);
    if (transport.command) execute(*transport.command);
    if (transport.speed) session_.speed = *transport.speed;
    if (transport.seek) {
      session_.paused = true;
      session_.seek(*transport.seek);
    }
    if (drawer > 0.0f) costsPanel({gap, h - bar - drawer - 2.0f * gap, w - 2.0f * gap, drawer}, session_);
  }
  if (help_) helpPanel({0.0f, 0.0f, w, h}, help_);
  if (built_.valid())
    messagePanel({0.0f, 0.0f, w, h - 4.0f * unit}, buildingText());
  else if (message_left_ > 0.0f)
    messagePanel({0.0f, 0.0f, w, h - 4.0f * unit}, message_);
}

void Browser::saveScreenshot() {
  const auto path = options_.pictures / (session_.spec().sample + "_" + session_.spec().name + "_" +
                                         std::to_string(session_.step()) + ".png");
  try {
    writePng(path, renderer_->readBack());
    say("saved " + path.string());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Browser::toggleRecording() {
  if (!session_.isRecording()) {
    session_.startRecording();
    say("recording");
    return;
  }
  const auto path = options_.pictures / (session_.spec().sample + "_" + session_.spec().name + "_" +
                                         std::to_string(session_.step()) + ".rec");
  try {
    std::filesystem::create_directories(options_.pictures);
    writeFile(path, session_.stopRecording());
    say("saved " + path.string());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

// A scene may take seconds to build: the window goes on meanwhile. One that is wanted while another is being built is
// next.
void Browser::beginBuilding() {
  if (pending_.empty() || built_.valid()) return;
  building_ = std::exchange(pending_, "");
  building_since_ = Clock::now();
  const SceneSpec spec = findScene(scenes_, building_);
  const RunSettings settings{.threads = session_.settings.threads};
  built_ = std::async(std::launch::async, [spec, settings] { return std::make_unique<SceneRun>(spec, settings); });
}

void Browser::finishBuilding() {
  if (!built_.valid() || built_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const std::string target = std::exchange(building_, "");
  try {
    session_.take(built_.get());
    session_.settings = {.threads = session_.settings.threads};
  } catch (const std::exception& error) {
    say(target + ": " + error.what());
    return;
  }
  settings_.target = target;
  showScene();
  session_.paused = false;
}

std::string Browser::buildingText() const {
  const double seconds = std::chrono::duration<double>(Clock::now() - building_since_).count();
  char text[32];
  std::snprintf(text, sizeof text, " ... %.1f s", seconds);
  return "building " + building_ + text;
}

void Browser::drawFrame(const UiInput::Frame& input, float dt) {
  feed(ImGui::GetIO(), input, {width_, height_, std::max(dt, 1e-4f)});
  ImGui::NewFrame();
  layOutPanels();
  ImGui::Render();
  handleKeys(input, dt);
  handleMouse(input);
  beginBuilding();
  finishBuilding();
  session_.advance(dt);
  record();
  FrameInput frame = frameInput();
  const bool without_ui = screenshot_;
  if (!without_ui) frame.ui = ImGui::GetDrawData();
  stats_ = renderer_->draw(frame, list_);
  if (without_ui) saveScreenshot();
  screenshot_ = false;
  renderer_->blit(width_, height_);
  window_->present();
}

int Browser::run() {
  auto last = Clock::now();
  std::string shown_title;
  int idle = 0;  // pictures since something changed
  for (uint64_t frames = 0; !window_->shouldClose() && !quit_;) {
    const WindowInput input = window_->poll();
    const bool resized = input.width != width_ || input.height != height_;
    const bool moved = input.mouse_x != mouse_x_ || input.mouse_y != mouse_y_;
    input_.add(input);
    width_ = std::clamp(input.width, 1, 8192);
    height_ = std::clamp(input.height, 1, 8192);
    const bool busy = !session_.paused || resized || moved || input_.waiting() || !input.characters.empty() ||
                      input.wheel_y != 0.0f || drag_ != DragMode::None || message_left_ > 0.0f || !pending_.empty() ||
                      built_.valid() ||
                      !input.keys.empty();
    idle = busy ? 0 : idle + 1;
    const auto now = Clock::now();
    const float dt = float(std::min(std::chrono::duration<double>(now - last).count(), 0.25));
    last = now;
    // A picture that would be the last one again is not drawn; two more settle the user interface.
    if (idle <= 3 || options_.frames > 0) {
      const UiInput::Frame& frame = input_.next();
      drawFrame(frame, dt);
      input_.endFrame();
      message_left_ -= dt;
      if (++frames == options_.frames) break;
    }
    if (title() != shown_title) window_->setTitle(shown_title = title());
    std::this_thread::sleep_until(now + std::chrono::duration<double>(kFrameTime));
    settings_.width = width_;
    settings_.height = height_;
  }
  settings_.speed = session_.speed;
  writeSettings(settingsFile(), settings_);
  return 0;
}

int browse(const BrowseOptions& options) { return Browser(options).run(); }

}  // namespace viewer
