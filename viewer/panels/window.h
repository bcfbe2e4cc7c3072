// A fixed window for a panel, closed at the end of its scope.
#pragma once

#include <imgui.h>

#include "viewer/panels/panels.h"

namespace viewer {

class PanelWindow {
 public:
  PanelWindow(const char* title, const PanelArea& area, ImGuiWindowFlags extra = 0) {
    ImGui::SetNextWindowPos(ImVec2(area.x, area.y));
    ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus | extra);
  }
  ~PanelWindow() { ImGui::End(); }
  PanelWindow(const PanelWindow&) = delete;
  PanelWindow& operator=(const PanelWindow&) = delete;
};

}  // namespace viewer
