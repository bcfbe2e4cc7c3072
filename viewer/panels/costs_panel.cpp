// What the stages of a step cost: a table with now, mean and most, and a stacked plot over the last steps.
#include <algorithm>
#include <numeric>

#include "viewer/panels/window.h"

namespace viewer {

namespace {

ImU32 stageColor(size_t index) {
  return ImGui::ColorConvertFloat4ToU32(
      ImVec4(ImColor::HSV(float(index) * 0.618034f - float(int(float(index) * 0.618034f)), 0.5f, 0.85f)));
}

// Bars of the steps, newest at the right, the stages on top of one another.
void stackedPlot(const std::vector<StageCost>& costs, const std::vector<float>& totals, const ImVec2& size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy(size);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, ImVec2(at.x + size.x, at.y + size.y), ImGui::GetColorU32(ImGuiCol_FrameBg), 4.0f);
  // Scaled to what nearly all steps need: a single one that the system interrupted would flatten all others.
  std::vector<float> sorted = totals;
  std::sort(sorted.begin(), sorted.end());
  const float most = std::max(1.2f * sorted[sorted.size() * 95 / 100], 1e-4f);
  draw.PushClipRect(at, ImVec2(at.x + size.x, at.y + size.y), true);
  const float bar = size.x / float(Session::kRecent);
  for (size_t step = 0; step < totals.size(); ++step) {
    const float x = at.x + size.x - bar * float(totals.size() - step);
    float y = at.y + size.y;
    for (size_t i = 0; i < costs.size(); ++i) {
      const float height = costs[i].recent[step] / most * (size.y - 4.0f);
      draw.AddRectFilled(ImVec2(x, y - height), ImVec2(x + std::max(bar - 0.3f, 1.0f), y), stageColor(i));
      y -= height;
    }
  }
  draw.PopClipRect();
  char text[32];
  std::snprintf(text, sizeof text, "%.2f ms", double(most));
  draw.AddText(ImVec2(at.x + 5.0f, at.y + 3.0f), ImGui::GetColorU32(ImGuiCol_Text), text);
}

}  // namespace

void costsPanel(const PanelArea& area, const Session& session) {
  const PanelWindow window("Costs", area);
  if (session.totals().empty()) {
    ImGui::TextDisabled("no step was made yet");
    return;
  }
  const float table_width = std::min(26.0f * ImGui::GetFontSize(), 0.5f * area.width);
  ImGui::BeginChild("table", ImVec2(table_width, 0.0f));
  if (ImGui::BeginTable("costs", 4, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("stage", ImGuiTableColumnFlags_WidthStretch);
    for (const char* column : {"now ms", "mean", "most"})
      ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthFixed, 4.2f * ImGui::GetFontSize());
    ImGui::TableHeadersRow();
    const auto line = [](const char* stage, const std::vector<float>& v, ImU32 color) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, color);
      ImGui::TextUnformatted("# ");
      ImGui::PopStyleColor();
      ImGui::SameLine(0.0f, 0.0f);
      ImGui::TextUnformatted(stage);
      const float mean = std::accumulate(v.begin(), v.end(), 0.0f) / float(v.size());
      for (const float value : {v.back(), mean, *std::max_element(v.begin(), v.end())}) {
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", double(value));
      }
    };
    line("a step", session.totals(), ImGui::GetColorU32(ImGuiCol_TextDisabled));
    for (size_t i = 0; i < session.costs().size(); ++i)
      line(session.costs()[i].name.c_str(), session.costs()[i].recent, stageColor(i));
    ImGui::EndTable();
  }
  ImGui::EndChild();
  ImGui::SameLine();
  stackedPlot(session.costs(), session.totals(), ImGui::GetContentRegionAvail());
}

}  // namespace viewer
