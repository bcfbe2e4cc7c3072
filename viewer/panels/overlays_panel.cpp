// Check boxes of what is drawn on top of the scene.
#include "viewer/panels/window.h"

namespace viewer {

void overlaysSection(Overlays& overlays) {
  const char* group = "";
  int column = 0;
  const float second = 0.5f * ImGui::GetContentRegionAvail().x;
  for (const OverlayInfo& info : overlayTable()) {
    if (std::string_view(group) != info.group) {
      group = info.group;
      column = 0;
      ImGui::Spacing();
      ImGui::TextDisabled("%s", group);
    }
    if (column++ % 2 == 1) ImGui::SameLine(second);
    ImGui::PushID(&info);
    ImGui::Checkbox(info.label, &(overlays.*info.flag));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.help);
    ImGui::PopID();
  }
  ImGui::Spacing();
  if (ImGui::SmallButton("none")) overlays = {};
}

}  // namespace viewer
