// The panel on the right: the selection, islands, what is drawn, and the scene with its figures.
#include "viewer/panels/window.h"

namespace viewer {

namespace {

void sceneTab(Session& session, SideEdit& edit) {
  const auto section = [](const char* title) {
    return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
  };
  ImGui::TextWrapped("%s", session.spec().shows.c_str());
  ImGui::Spacing();
  if (!session.isExact()) ImGui::TextDisabled("an earlier step: only poses are known");
  readingsSection(session);
  if (!session.parameters().empty() && section("Parameters")) parametersSection(session, edit);
  if (section("Figures")) countersSection(session);
  if (section("Solver")) solverSection(session, edit);
}

// A tab that comes to the front when it is wanted.
template <class Draw>
void tab(const char* name, bool wanted, const Draw& draw) {
  if (!ImGui::BeginTabItem(name, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0)) return;
  ImGui::BeginChild(name);
  draw();
  ImGui::EndChild();
  ImGui::EndTabItem();
}

}  // namespace

SideEdit sidePanel(const PanelArea& area, Session& session, const SideState& state) {
  SideEdit edit;
  const PanelWindow window("Inspector", area);
  if (!ImGui::BeginTabBar("tabs")) return edit;
  tab("Scene", state.show == SideTab::Scene, [&] { sceneTab(session, edit); });
  tab("Selection", state.show == SideTab::Selection,
      [&] { edit.inspector = inspectorSection(session.world(), state.selected, state.marked); });
  tab("Islands", state.show == SideTab::Islands,
      [&] { edit.inspector.selected = islandsSection(session.world(), state.selected); });
  tab("Show", state.show == SideTab::Show, [&] { overlaysSection(*state.overlays); });
  ImGui::EndTabBar();
  return edit;
}

}  // namespace viewer
