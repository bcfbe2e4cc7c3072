// The list of islands, sorted by what is asked for.
#include <algorithm>
#include <numeric>

#include "viewer/inspect/island_facts.h"
#include "viewer/panels/window.h"

namespace viewer {
namespace {

enum Column { kIsland, kBodies, kContacts, kJoints, kStill };

double valueOf(const pfx::World& world, uint32_t index, int column) {
  const pfx::IslandView island = world.island(index);
  switch (column) {
    case kBodies:
      return double(island.bodies.size());
    case kContacts:
      return double(island.contacts.size());
    case kJoints:
      return double(island.joints);
    case kStill:
      return island.asleep ? 1e9 : double(island.sleep_timer);
    default:
      return double(index);
  }
}

std::vector<uint32_t> sortedIslands(const pfx::World& world) {
  std::vector<uint32_t> order(world.numIslands());
  std::iota(order.begin(), order.end(), 0u);
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (!specs || specs->SpecsCount == 0) return order;
  const auto& by = specs->Specs[0];
  std::vector<double> value;
  for (uint32_t i : order) value.push_back(valueOf(world, i, by.ColumnIndex));
  const bool down = by.SortDirection == ImGuiSortDirection_Descending;
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return down ? value[a] > value[b] : value[a] < value[b]; });
  return order;
}

}  // namespace

std::optional<Selection> islandsSection(const pfx::World& world, const Selection& selected) {
  std::optional<Selection> chosen;
  if (world.numIslands() == 0) ImGui::TextDisabled("no island is awake");
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable |
      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable("islands", 5, kFlags)) return chosen;
  for (const char* column : {"island", "bodies", "contacts", "joints", "still for"}) ImGui::TableSetupColumn(column);
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableHeadersRow();
  const std::vector<uint32_t> order = sortedIslands(world);
  const auto current =
      selected.kind == PickKind::Island ? islandOfBody(world, selected.body.index) : std::nullopt;
  ImGuiListClipper clipper;
  clipper.Begin(int(order.size()));
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const uint32_t i = order[size_t(row)];
      const pfx::IslandView island = world.island(i);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      if (ImGui::Selectable(std::to_string(i).c_str(), current == i, ImGuiSelectableFlags_SpanAllColumns))
        chosen = selectIsland(world, i);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", explainSleep(world, i).why.c_str());
      ImGui::TableNextColumn();
      ImGui::Text("%zu", island.bodies.size());
      ImGui::TableNextColumn();
      ImGui::Text("%zu", island.contacts.size());
      ImGui::TableNextColumn();
      ImGui::Text("%u", island.joints);
      ImGui::TableNextColumn();
      island.asleep ? ImGui::TextUnformatted("asleep") : ImGui::Text("%.2f s", double(island.sleep_timer));
    }
  ImGui::EndTable();
  return chosen;
}

}  // namespace viewer
