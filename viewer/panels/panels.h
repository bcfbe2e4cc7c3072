// The browser's panels: free functions that draw a model and return what the user asked for. They know ImGui
// and the engine, but neither the window nor the renderer.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "viewer/browse/commands.h"
#include "viewer/browse/session.h"
#include "viewer/inspect/selection.h"
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

// Play, step, restart, timeline, speed, recording.
struct TransportEdit {
  std::optional<BrowseCommand> command;
  std::optional<uint64_t> seek;
  std::optional<float> speed;
};
TransportEdit transportPanel(const PanelArea& area, const Session& session);

// What is drawn of one triangle of a large mesh.
struct MeshMark {
  pfx::MeshTriangleId triangle;
  pfx::MeshDraw what;
};

// What the inspector asks for.
struct InspectorEdit {
  std::optional<Selection> selected;
  std::optional<BrowseCommand> command;
  std::optional<MeshMark> mark;
};
// All about the selection; `marked`: what is drawn of the selected triangle.
InspectorEdit inspectorSection(const pfx::World& world, const Selection& selected, pfx::MeshDraw marked);
std::optional<Selection> islandsSection(const pfx::World& world, const Selection& selected);

// The panel on the right. Returns whether the scene has to be restarted for a setting to act.
enum class SideTab { Same, Scene, Selection, Islands, Show };
struct SideEdit {
  bool restart = false;
  std::vector<SceneInput> inputs;  // to be given to the session
  InspectorEdit inspector;
};
struct SideState {
  Overlays* overlays;
  Selection selected;
  pfx::MeshDraw marked = pfx::MeshDraw::None;
  SideTab show = SideTab::Same;  // the tab to bring to the front
};
SideEdit sidePanel(const PanelArea& area, Session& session, const SideState& state);

// The sections of the side panel. Parameters and solver settings that act only from a restart are put into
// `session.settings`.
void countersSection(const Session& session);
void readingsSection(const Session& session);
void overlaysSection(Overlays& overlays);
void parametersSection(Session& session, SideEdit& edit);
void solverSection(Session& session, SideEdit& edit);

// Table and plots of what the stages cost.
void costsPanel(const PanelArea& area, const Session& session);

// All keys and mouse gestures. Closes itself on a click outside of it.
void helpPanel(const PanelArea& screen, bool& open);

// A short text in the lower middle of the screen.
void messagePanel(const PanelArea& screen, const std::string& text);

}  // namespace viewer
