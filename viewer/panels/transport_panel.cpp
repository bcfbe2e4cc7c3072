// Play, step, restart, timeline and speed, in one row.
#include <cstdio>

#include "viewer/panels/window.h"

namespace viewer {

TransportEdit transportPanel(const PanelArea& area, const Session& session) {
  TransportEdit edit;
  const PanelWindow window("Transport", area, ImGuiWindowFlags_NoScrollbar);
  const auto button = [&](const char* text, const char* help, BrowseCommand command, float width) {
    if (ImGui::Button(text, ImVec2(width, 0.0f))) edit.command = command;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    ImGui::SameLine();
  };
  const float unit = ImGui::GetFontSize();
  button("|<", "restart (R)", BrowseCommand::Restart, 2.4f * unit);
  button("<", "one step back (,)", BrowseCommand::StepBack, 2.4f * unit);
  button(session.paused ? "play" : "pause", "Space", BrowseCommand::Pause, 4.2f * unit);
  button(">", "one step (.)", BrowseCommand::Step, 2.4f * unit);

  // The timeline: everything that is remembered.
  uint64_t step = session.step();
  const uint64_t first = session.firstStep(), last = std::max(session.lastStep(), first + 1);
  char text[48];
  std::snprintf(text, sizeof text, "step %%llu   %.2f s", double(step) * double(session.settings.dt));
  ImGui::SetNextItemWidth(std::max(8.0f * unit, ImGui::GetContentRegionAvail().x - 11.0f * unit));
  if (ImGui::SliderScalar("##timeline", ImGuiDataType_U64, &step, &first, &last, text)) edit.seek = step;
  ImGui::SameLine();
  float speed = session.speed;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##speed", &speed, 0.05f, 4.0f, "speed %.2f", ImGuiSliderFlags_Logarithmic))
    edit.speed = speed;
  return edit;
}

}  // namespace viewer
