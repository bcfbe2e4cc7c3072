#include "viewer/panels/fact_table.h"

#include <algorithm>

namespace viewer {
namespace {

bool isReference(const Json& value) { return value.is_object() && value.contains("name") && value.contains("index"); }

constexpr NumberFormat kShort = {.digits = 4, .remarks = false};

// Text that can be clicked.
bool link(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62f, 0.33f, 0.10f, 1.0f));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  return ImGui::IsItemClicked();
}

// Where the line of a triangle leads, in a sheet that names its mesh.
std::optional<Selection> triangleOf(const pfx::World& world, const FactSheet& sheet, const Fact& fact) {
  if (fact.key != "triangle") return std::nullopt;
  const auto mesh = std::find_if(sheet.facts.begin(), sheet.facts.end(), [](const Fact& f) { return f.key == "mesh"; });
  if (mesh == sheet.facts.end()) return std::nullopt;
  return selectTriangle(world, mesh->value["index"].get<uint32_t>(), fact.value.get<uint32_t>());
}

// Lists of numbers get a line a row, so that nothing runs out of the panel.
void value(const Fact& fact) {
  if (fact.value.is_array() && !fact.value.empty() && fact.value.front().is_structured()) {
    for (const Json& part : fact.value) ImGui::TextUnformatted(valueText({"", part, fact.unit}, kShort).c_str());
    return;
  }
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(valueText(fact, kShort).c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

bool beginFacts(const char* id) {
  const bool open = ImGui::BeginTable(id, 2, ImGuiTableFlags_RowBg);
  if (!open) return false;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 7.8f * ImGui::GetFontSize());
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

std::optional<Selection> factTable(const char* id, const pfx::World& world, const FactSheet& sheet) {
  std::optional<Selection> chosen;
  if (beginFacts(id)) {
    for (const Fact& fact : sheet.facts) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(labelOf(fact).c_str());
      if (*fact.unit && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", fact.unit + (*fact.unit == ','));
      ImGui::TableNextColumn();
      if (const auto triangle = triangleOf(world, sheet, fact)) {
        if (link(valueText(fact))) chosen = triangle;
      } else if (!isReference(fact.value)) {
        value(fact);
      } else if (link(valueText(fact))) {
        chosen = selectBody(world, fact.value["index"].get<uint32_t>());
      }
    }
    ImGui::EndTable();
  }
  for (const FactList& list : sheet.lists)
    for (size_t i = 0; i < list.items.size(); ++i) {
      const std::string name = list.key.substr(0, list.key.size() - (list.key == "axes" ? 2 : 1));
      const std::string title = list.key == "axes" ? list.items[i].facts.front().value.get<std::string>() + ": " +
                                                         list.items[i].facts[1].value.get<std::string>()
                                                   : name + " " + std::to_string(i + 1);
      ImGui::PushID(int(i));
      if (ImGui::TreeNodeEx(title.c_str(), i < 4 && list.key != "axes" ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
        if (const auto inner = factTable(list.key.c_str(), world, list.items[i])) chosen = inner;
        ImGui::TreePop();
      }
      ImGui::PopID();
    }
  return chosen;
}

}  // namespace viewer
