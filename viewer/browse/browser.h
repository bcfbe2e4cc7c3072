// The browser's state and what changes it. The loop is in browser.cpp, keys and mouse are in
// browser_input.cpp.
#pragma once

#include <imgui.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "viewer/browse/browse.h"
#include "viewer/browse/camera_control.h"
#include "viewer/browse/commands.h"
#include "viewer/browse/session.h"
#include "viewer/browse/settings.h"
#include "viewer/browse/ui_input.h"
#include "viewer/panels/panels.h"
#include "viewer/render/renderer.h"
#include "viewer/run/world_view.h"

namespace viewer {

class Browser {
 public:
  explicit Browser(const BrowseOptions& options);
  int run();

 private:
  struct UiContext {
    UiContext() : context(ImGui::CreateContext()) {}
    ~UiContext() { ImGui::DestroyContext(context); }
    ImGuiContext* context;
  };

  // The loop.
  void drawFrame(const UiInput::Frame& input, float dt);
  void layOutPanels();
  void layOutSide(const PanelArea& area);
  void record();
  void load(const std::string& target);
  void requestLoad(const std::string& target) { pending_ = target; }
  void beginBuilding();
  void finishBuilding();
  std::string buildingText() const;
  void openRecording(const std::string& file);
  void showScene();
  void restart();
  void say(const std::string& text) { message_ = text, message_left_ = 3.0f; }
  void saveScreenshot();
  void toggleRecording();
  bool steers() const { return steering_ && session_.scene().isControlled(); }
  void steer(const UiInput::Frame& input);
  std::string title() const;

  // Keys and mouse.
  void handleKeys(const UiInput::Frame& input, float dt);
  void handleMouse(const UiInput::Frame& input);
  void beginDrag(const UiInput::Frame& input);
  void endDrag(const UiInput::Frame& input);
  void execute(BrowseCommand command);
  bool executeView(BrowseCommand command);
  bool executeOverlay(BrowseCommand command);
  void changeScene(int by);
  void frameSelection();
  void throwBall();
  PickHit pickAt(float x, float y);
  Ray mouseRay(float x, float y) const;
  void select(const Selection& selection);
  void addHovered();
  std::vector<uint8_t> selectedBodies() const;
  Trails recentTrails() const;
  FrameInput frameInput() const;

  enum class DragMode { None, Orbit, Pan, Pull };

  BrowseOptions options_;
  std::vector<SceneSpec> scenes_;
  BrowseSettings settings_;
  Session session_;
  std::unique_ptr<Window> window_;
  UiContext ui_;
  std::unique_ptr<Renderer> renderer_;
  DrawList list_;
  std::unique_ptr<WorldView> view_;
  UiInput input_;

  CameraControl camera_;
  SceneListState list_state_;
  Selection selected_;
  SideTab show_tab_ = SideTab::Same;  // to bring to the front in the next frame
  bool follow_ = false, help_ = false, quit_ = false, screenshot_ = false, steering_ = true;
  samples::Controls controls_;  // that were given last
  DragMode drag_ = DragMode::None;
  float drag_start_x_ = 0.0f, drag_start_y_ = 0.0f, mouse_x_ = 0.0f, mouse_y_ = 0.0f;
  float pull_depth_ = 0.0f;  // m along the view
  int width_ = 0, height_ = 0;
  float covered_right_ = 0.0f;  // px, by the panel
  std::string pending_;  // target of the scene that is wanted next
  std::string building_;  // target of the one that is being built meanwhile, on a thread of its own
  std::future<std::unique_ptr<SceneRun>> built_;
  std::chrono::steady_clock::time_point building_since_;
  std::string message_;
  float message_left_ = 0.0f;  // s
  std::vector<int> command_keys_;  // held keys that were pressed together with Shift or Ctrl
  RenderStats stats_;
};

}  // namespace viewer
