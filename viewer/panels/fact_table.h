// Facts as a table of two columns. What names a body or a joint is a link.
#pragma once

#include <imgui.h>

#include <optional>

#include "viewer/inspect/selection.h"

namespace viewer {

// Rows of a two-column table: what, value.
bool beginFacts(const char* id);
template <class... Args>
void factRow(const char* what, const char* format, Args... args) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
  ImGui::TableNextColumn();
  ImGui::Text(format, args...);
}

// The whole sheet, lists in sections of their own. Returns what a clicked link names.
std::optional<Selection> factTable(const char* id, const pfx::World& world, const FactSheet& sheet);

}  // namespace viewer
