// Play, step, restart, timeline, speed, recording and picture, in one row.
#include <cstdio>

#include "viewer/panels/window.h"

namespace viewer {

namespace {

// A red line across the timeline, at the first step that the run did not repeat.
void markDivergence(uint64_t step, uint64_t first, uint64_t last) {
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const float grab = ImGui::GetStyle().GrabMinSize, share = float(double(step - first) / double(last - first));
  const float x = from.x + 0.5f * grab + share * (to.x - from.x - grab);
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(x - 1.5f, from.y), ImVec2(x + 1.5f, to.y),
                                            IM_COL32(205, 40, 30, 255));
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("the run differs from the recording from step %llu on", static_cast<unsigned long long>(step));
}

}  // namespace

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

  const bool recording = session.isRecording();
  if (recording) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.85f, 0.30f, 0.25f, 1.0f));
  button(recording ? "stop" : "record", "every step into a file (Ctrl+R)", BrowseCommand::Record, 4.2f * unit);
  if (recording) ImGui::PopStyleColor();
  button("picture", "save a picture (F12)", BrowseCommand::Screenshot, 4.2f * unit);

  // The timeline: everything that is remembered.
  uint64_t step = session.step();
  const uint64_t first = session.firstStep(), last = std::max(session.lastStep(), first + 1);
  char text[64];
  std::snprintf(text, sizeof text, "step %%llu   %.2f s%s", double(step) * double(session.timeStep()),
                session.isReplay() ? "   recording" : "");
  ImGui::SetNextItemWidth(std::max(8.0f * unit, ImGui::GetContentRegionAvail().x - 11.0f * unit));
  if (ImGui::SliderScalar("##timeline", ImGuiDataType_U64, &step, &first, &last, text)) edit.seek = step;
  if (const auto divergence = session.divergence()) markDivergence(*divergence, first, last);
  ImGui::SameLine();
  float speed = session.speed;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##speed", &speed, 0.05f, 4.0f, "speed %.2f", ImGuiSliderFlags_Logarithmic))
    edit.speed = speed;
  return edit;
}

}  // namespace viewer
