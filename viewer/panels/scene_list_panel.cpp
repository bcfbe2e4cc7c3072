// The list of samples and their scenes.
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "viewer/panels/window.h"

namespace viewer {

namespace {

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

bool matchesFilter(std::string_view text, std::string_view filter) {
  size_t at = 0;
  for (const char c : text)
    if (at < filter.size() && lower(c) == lower(filter[at])) ++at;
  return at == filter.size();
}

std::optional<std::string> sceneListPanel(const PanelArea& area, std::span<const SceneSpec> scenes,
                                          std::string_view current, SceneListState& state) {
  std::optional<std::string> chosen;
  const PanelWindow window("Samples", area);
  if (state.focus_filter) ImGui::SetKeyboardFocusHere();
  state.focus_filter = false;
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered =
      ImGui::InputTextWithHint("##filter", "search (Ctrl+O)", state.filter, sizeof state.filter,
                               ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  const auto shown = [&](const SceneSpec& s) {
    return matchesFilter(s.target(), state.filter) || matchesFilter(s.shows, state.filter);
  };
  if (entered) {
    // A match in the name is meant rather than one in the description.
    auto first = std::find_if(scenes.begin(), scenes.end(),
                              [&](const SceneSpec& s) { return matchesFilter(s.target(), state.filter); });
    if (first == scenes.end()) first = std::find_if(scenes.begin(), scenes.end(), shown);
    if (first != scenes.end()) {
      chosen = first->target();
      state.filter[0] = '\0';
    }
  }
  ImGui::Separator();
  ImGui::BeginChild("scenes");
  std::string_view sample;
  for (const SceneSpec& s : scenes) {
    if (!shown(s)) continue;
    if (s.sample != sample) {
      if (!sample.empty()) ImGui::Spacing();
      ImGui::TextDisabled("%s", s.sample.c_str());
      sample = s.sample;
    }
    ImGui::PushID(&s);
    ImGui::Indent(8.0f);
    const std::string target = s.target();
    if (ImGui::Selectable(s.name.c_str(), target == current)) chosen = target;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", s.shows.c_str());
    ImGui::Unindent(8.0f);
    ImGui::PopID();
  }
  if (sample.empty()) ImGui::TextDisabled("no scene matches");
  ImGui::EndChild();
  return chosen;
}

}  // namespace viewer
