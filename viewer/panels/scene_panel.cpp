// The scene: what it proves, its parameters, its figures, and the solver's settings.
#include <algorithm>
#include <cmath>

#include "viewer/panels/fact_table.h"
#include "viewer/panels/window.h"

namespace viewer {

void readingsSection(const Session& session) {
  const std::vector<samples::Reading> readings = session.scene().readings(session.world());
  if (readings.empty() || !ImGui::CollapsingHeader("Readings", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("readings", 3, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 2.0f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.2f);
  ImGui::TableSetupColumn("at most", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableHeadersRow();
  for (const samples::Reading& r : readings) {
    const bool over = r.limit != 0.0 && !(r.value <= r.limit);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%.*s", int(r.name.size()), r.name.data());
    ImGui::TableNextColumn();
    if (over) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.78f, 0.16f, 0.13f, 1.0f));
    ImGui::Text("%.4g %.*s", r.value, int(r.unit.size()), r.unit.data());
    if (over) ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    if (r.limit != 0.0) ImGui::Text("%.4g", r.limit);
  }
  ImGui::EndTable();
}

void parametersSection(Session& session, SideEdit& edit) {
  const std::vector<samples::Parameter> all = session.parameters();
  std::vector<float> values;
  for (const samples::Parameter& p : all) values.push_back(*p.value);
  for (uint32_t i = 0; i < all.size(); ++i) {
    const samples::Parameter& p = all[i];
    const std::string name(p.name), format = "%.4g " + std::string(p.unit);
    const bool changed = ImGui::SliderFloat(name.c_str(), &values[i], p.low, p.high, format.c_str());
    if (p.takes == samples::Parameter::Takes::OnRestart) {
      // Restarting while the slider moves would build the scene again and again.
      if (changed) session.settings.parameters = values;
      if (ImGui::IsItemDeactivatedAfterEdit()) edit.restart = true;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("starts the scene again");
    } else if (changed) {
      session.settings.parameters = values;
      edit.inputs.push_back(SetParameter{i, values[i]});
    }
  }
  if (ImGui::SmallButton("as the scene has them")) {
    session.settings.parameters.clear();
    edit.restart = true;
  }
}

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
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 2.3f * ImGui::GetFontSize());
    ImGui::PlotLines(id, values.data(), int(values.size()), 0, label, FLT_MAX, FLT_MAX, size);
  };
  plot("##energy", session.energies(), "energy");
  plot("##momentum", session.momenta(), "momentum");
  plot("##penetration", session.penetrations(), "overlap");
  if (f.counts.joints > 0) plot("##joint error", session.jointErrors(), "joint error");
}

void solverSection(Session& session, SideEdit& edit) {
  const pfx::SolverSettings before = session.world().solver();
  pfx::SolverSettings solver = before;
  if (ImGui::SliderInt("sub-steps", &solver.substeps, 1, 32)) solver.substeps = std::clamp(solver.substeps, 1, 32);
  const auto choose = [](const char* label, auto& choice, const char* names) {
    int index = int(choice);
    if (ImGui::Combo(label, &index, names)) choice = std::decay_t<decltype(choice)>(index);
  };
  choose("contacts", solver.contact_solver, "automatic\0sequential impulses\0Newton's method\0");
  choose("joints", solver.joint_solver, "automatic\0direct\0soft\0");
  if (solver != before) {
    session.settings.substeps = solver.substeps;
    session.settings.joint_solver = solver.joint_solver;
    session.settings.contact_solver = solver.contact_solver;
    edit.inputs.push_back(solver);
  }
  float hertz = 1.0f / session.timeStep();
  if (ImGui::SliderFloat("steps a second", &hertz, 15.0f, 480.0f, "%.0f Hz", ImGuiSliderFlags_Logarithmic)) {
    session.settings.dt = 1.0f / std::max(1.0f, std::round(hertz));
    edit.inputs.push_back(SetTimeStep{session.settings.dt});
  }
  ImGui::SliderInt("threads", &session.settings.threads, 1, 8);
  if (ImGui::IsItemDeactivatedAfterEdit()) edit.restart = true;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("starts the scene again; the result is the same for any number");
}

}  // namespace viewer
