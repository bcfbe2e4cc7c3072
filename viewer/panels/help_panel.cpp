// The help, made from the table of keys, and short messages.
#include <algorithm>

#include "viewer/panels/window.h"

namespace viewer {

void helpPanel(const PanelArea& screen, bool& open) {
  const float unit = ImGui::GetFontSize();
  const float width = std::min(screen.width - 2.0f * unit, 52.0f * unit),
              height = std::min(screen.height - 2.0f * unit, 37.0f * unit);
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.97f);
  ImGui::SetNextWindowPos(ImVec2(0.5f * (screen.width - width), 0.5f * (screen.height - height)));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("Keys and mouse", &open,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  const auto keys = keyBindings();
  const size_t half = (keys.size() + 1) / 2;
  if (ImGui::BeginTable("keys", 4)) {
    for (const char* half_name : {"left", "right"}) {
      ImGui::TableSetupColumn(half_name, ImGuiTableColumnFlags_WidthFixed, 5.5f * unit);
      ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    }
    for (size_t i = 0; i < half; ++i)
      for (const size_t k : {i, i + half}) {
        ImGui::TableNextColumn();
        if (k < keys.size()) ImGui::TextDisabled("%s", keys[k].keys);
        ImGui::TableNextColumn();
        if (k < keys.size()) ImGui::TextUnformatted(keys[k].help);
      }
    ImGui::EndTable();
  }
  ImGui::Separator();
  if (ImGui::BeginTable("mouse", 2)) {
    ImGui::TableSetupColumn("gesture", ImGuiTableColumnFlags_WidthFixed, 12.0f * unit);
    ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    for (const MouseHelp& m : mouseHelp()) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", m.gesture);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(m.help);
    }
    ImGui::EndTable();
  }
  const bool outside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  ImGui::End();
  if (outside) open = false;
}

void messagePanel(const PanelArea& screen, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = 10.0f;
  ImGui::SetNextWindowPos(
      ImVec2(0.5f * (screen.width - size.x) - pad, screen.y + screen.height - size.y - 2.0f * pad));
  ImGui::SetNextWindowSize(ImVec2(size.x + 2.0f * pad, size.y + 2.0f * pad));
  ImGui::Begin("Message", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

}  // namespace viewer
