// The browser's panels: free functions that draw a model and return what the user asked for. They know ImGui
// and the engine, but neither the window nor the renderer.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "viewer/browse/commands.h"
#include "viewer/browse/session.h"
#include "viewer/draw_list/draw_list.h"
#include "viewer/run/overlays.h"

namespace viewer {

// Where a panel lies, px.
struct PanelArea {
  float x, y, width, height;
};

// Whether `filter` is a part of `text`, or its letters follow one another in it; capitals do not count. An
// empty filter matches everything.
bool matchesFilter(std::string_view text, std::string_view filter);

// Samples and scenes with a search field. Returns the target of a scene that was chosen: by a click, or as
// the first that matches by Enter in the search field.
struct SceneListState {
  char filter[64] = "";
  bool focus_filter = false;  // put the cursor into the search field in the next frame
};
std::optional<std::string> sceneListPanel(const PanelArea& area, std::span<const SceneSpec> scenes,
                                          std::string_view current, SceneListState& state);

// Play, step, restart, timeline, speed.
struct TransportEdit {
  std::optional<BrowseCommand> command;
  std::optional<uint64_t> seek;
  std::optional<float> speed;
};
TransportEdit transportPanel(const PanelArea& area, const Session& session);

// Counters, overlays, solver settings, and what is known of the selection. Returns whether the scene has to
// be restarted for a setting to act, and what was selected.
struct SideEdit {
  bool restart = false;
  std::optional<uint32_t> selected;  // pick id
};
struct SideState {
  Overlays* overlays;
  RunSettings* settings;
  uint32_t selected;  // pick id
};
SideEdit sidePanel(const PanelArea& area, const Session& session, const SideState& state);

// The sections of the side panel.
void countersSection(const Session& session);
void overlaysSection(Overlays& overlays);
bool solverSection(RunSettings& settings, const pfx::WorldDef& def);
void bodySection(const pfx::World& world, uint32_t body);
std::optional<uint32_t> islandSection(const pfx::World& world, uint32_t selected);

// Table and plots of what the stages cost.
void costsPanel(const PanelArea& area, const Session& session);

// All keys and mouse gestures. Closes itself on a click outside of it.
void helpPanel(const PanelArea& screen, bool& open);

// A short text in the lower middle of the screen.
void messagePanel(const PanelArea& screen, const std::string& text);

}  // namespace viewer
