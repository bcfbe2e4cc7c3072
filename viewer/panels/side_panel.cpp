// The panel on the right: the selection, islands, what is drawn, and the scene with its figures.
#include <cmath>

#include "viewer/panels/fact_table.h"
#include "viewer/panels/window.h"

namespace viewer {

void countersSection(const Session& session) {
  const Figures& f = session.figures();
  const pfx::WorldCounts& c = f.counts;
  if (!beginFacts("counters")) return;
  factRow("bodies", "%u, %u awake", c.bodies, c.awake);
  factRow("pairs", "%u, %u touching", c.pairs, c.touching_pairs);
  factRow("contact points", "%u", c.contact_points);
  factRow("islands", "%u", c.islands);
  factRow("joints", "%u", c.joints);
  factRow("kinetic energy", "%.4g J", f.kinetic_energy);
  factRow("potential energy", "%.4g J", f.potential_energy);
  factRow("momentum", "%.4g N s", f.linear_momentum.norm());
  factRow("deepest overlap", "%.3f mm", 1000.0 * f.max_penetration);
  factRow("joint error", "%.3f mm", 1000.0 * f.max_joint_error);
  factRow("fastest body", "%.3f m/s", f.max_speed);
  ImGui::EndTable();
  const auto plot = [](const char* id, const std::vector<float>& values, const char* label) {
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 2.6f * ImGui::GetFontSize());
    ImGui::PlotLines(id, values.data(), int(values.size()), 0, label, FLT_MAX, FLT_MAX, size);
  };
  plot("##energy", session.energies(), "energy");
  plot("##penetration", session.penetrations(), "overlap");
}

bool solverSection(RunSettings& settings, const pfx::WorldDef& def) {
  bool changed = false;
  int substeps = settings.substeps.value_or(def.substeps);
  if (ImGui::SliderInt("sub-steps", &substeps, 1, 32)) {
    settings.substeps = substeps;
    changed = true;
  }
  changed |= ImGui::SliderInt("threads", &settings.threads, 1, 8);
  float hertz = 1.0f / settings.dt;
  if (ImGui::SliderFloat("steps a second", &hertz, 15.0f, 480.0f, "%.0f Hz", ImGuiSliderFlags_Logarithmic)) {
    settings.dt = 1.0f / std::round(hertz);
    changed = true;
  }
  ImGui::TextDisabled("a change starts the scene again");
  return changed;
}

namespace {

void sceneTab(const Session& session, const SideState& state, SideEdit& edit) {
  ImGui::TextWrapped("%s", session.spec().shows.c_str());
  ImGui::Spacing();
  if (ImGui::CollapsingHeader("Figures", ImGuiTreeNodeFlags_DefaultOpen)) countersSection(session);
  if (ImGui::CollapsingHeader("Solver", ImGuiTreeNodeFlags_DefaultOpen))
    edit.restart = solverSection(*state.settings, session.world().def());
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

SideEdit sidePanel(const PanelArea& area, const Session& session, const SideState& state) {
  SideEdit edit;
  const PanelWindow window("Inspector", area);
  if (!ImGui::BeginTabBar("tabs")) return edit;
  tab("Scene", state.show == SideTab::Scene, [&] { sceneTab(session, state, edit); });
  tab("Selection", state.show == SideTab::Selection,
      [&] { edit.inspector = inspectorSection(session.world(), state.selected, state.marked); });
  tab("Islands", state.show == SideTab::Islands,
      [&] { edit.inspector.selected = islandsSection(session.world(), state.selected); });
  tab("Show", state.show == SideTab::Show, [&] { overlaysSection(*state.overlays); });
  ImGui::EndTabBar();
  return edit;
}

}  // namespace viewer
