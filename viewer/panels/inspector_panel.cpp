// What is known of the selection, and the way from it to its neighbours: contacts, joints, islands, triangles.
#include "viewer/inspect/island_facts.h"
#include "viewer/panels/fact_table.h"
#include "viewer/panels/window.h"

namespace viewer {
namespace {

using pfx::World;

// A line that can be clicked, of a list below the facts.
bool entry(const std::string& text, bool chosen = false) { return ImGui::Selectable(text.c_str(), chosen); }

// "1 point on triangle 24", "3 points".
std::string pointsText(const World& world, const pfx::Pair& pair, int points) {
  std::string text = std::to_string(points) + (points == 1 ? " point" : " points");
  const std::vector<uint32_t> triangles = touchedTriangles(world, pair);
  for (size_t i = 0; i < triangles.size(); ++i)
    text += (i > 0 ? ", " : triangles.size() == 1 ? " on triangle " : " on triangles ") + std::to_string(triangles[i]);
  return text;
}

// Contacts and joints of the bodies that `has` picks out.
template <class Has>
std::optional<Selection> neighbours(const World& world, const Has& has) {
  std::optional<Selection> chosen;
  if (ImGui::CollapsingHeader("Contacts", ImGuiTreeNodeFlags_DefaultOpen)) {
    uint32_t shown = 0;
    for (const pfx::Pair& pair : world.contactPairs()) {
      if (!has(pair.body_a) && !has(pair.body_b)) continue;
      int points = 0;
      for (const pfx::ContactManifold& m : world.manifolds(pair)) points += m.num_points;
      if (points == 0 || ++shown > 60) continue;
      ImGui::PushID(int(shown));
      if (entry(bodyTitle(world, pair.body_a) + " - " + bodyTitle(world, pair.body_b) + ", " +
                pointsText(world, pair, points)))
        chosen = selectContact(world, pair);
      ImGui::PopID();
    }
    if (shown == 0) ImGui::TextDisabled("touches nothing");
    if (shown > 60) ImGui::TextDisabled("and %u more", shown - 60);
  }
  bool headed = false;
  for (uint32_t i = 0; i < world.jointLinks().size(); ++i) {
    const pfx::JointLink& link = world.jointLinks()[i];
    if (!link.exists || (!has(link.body_a) && !has(link.body_b))) continue;
    if (!headed && !ImGui::CollapsingHeader("Joints", ImGuiTreeNodeFlags_DefaultOpen)) break;
    headed = true;
    ImGui::PushID(int(i));
    const std::string_view name = world.jointName(i);
    if (entry((name.empty() ? "joint " + std::to_string(i) : std::string(name)) + ": " +
              bodyTitle(world, link.body_a) + " - " + bodyTitle(world, link.body_b)))
      chosen = selectJoint(world, i);
    ImGui::PopID();
  }
  return chosen;
}

// Steps through islands and triangles of the mesh.
std::optional<Selection> triangleSteps(const World& world, const Selection& s, const pfx::LargeMesh& mesh) {
  const uint32_t island = pfx::islandOf(mesh, s.facet);
  int facet = int(s.facet), at = int(island);
  std::optional<Selection> chosen;
  ImGui::SetNextItemWidth(6.2f * ImGui::GetFontSize());
  if (ImGui::InputInt("triangle", &facet) && facet >= 0 && uint32_t(facet) < mesh.numFacets())
    chosen = selectTriangle(world, s.body.index, uint32_t(facet));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5.6f * ImGui::GetFontSize());
  if (ImGui::InputInt("island", &at) && at >= 0 && size_t(at) < mesh.islands.size())
    chosen = selectTriangle(world, s.body.index, mesh.islands[size_t(at)].first_facet);
  return chosen;
}

// What is drawn of this triangle alone.
std::optional<MeshMark> triangleMarks(const Selection& s, const pfx::LargeMesh& mesh, pfx::MeshDraw marked) {
  static constexpr std::pair<const char*, pfx::MeshDraw> kMarks[] = {{"mark edges", pfx::MeshDraw::Edge},
                                                                     {"box", pfx::MeshDraw::FacetAabb},
                                                                     {"normal", pfx::MeshDraw::Normal},
                                                                     {"thickness", pfx::MeshDraw::Thickness},
                                                                     {"its island", pfx::MeshDraw::Island}};
  const uint32_t island = pfx::islandOf(mesh, s.facet);
  std::optional<MeshMark> edit;
  for (const auto& [name, flag] : kMarks) {
    bool on = pfx::has(marked, flag);
    if (name != kMarks[0].first && name != kMarks[3].first) ImGui::SameLine();
    if (ImGui::Checkbox(name, &on))
      edit = MeshMark{{s.body.index, island, s.facet - mesh.islands[island].first_facet},
                      pfx::MeshDraw(uint8_t(marked) ^ uint8_t(flag))};
  }
  return edit;
}

void islandFacts(const World& world, uint32_t index, InspectorEdit& edit) {
  const pfx::IslandView island = world.island(index);
  ImGui::TextWrapped("%s", explainSleep(world, index).why.c_str());
  if (beginFacts("island")) {
    factRow("bodies", "%zu", island.bodies.size());
    factRow("contacts", "%zu", island.contacts.size());
    factRow("joints", "%u", island.joints);
    factRow("still for", "%.2f s", double(island.sleep_timer));
    factRow("solved by", "%s", solverName(world, index).c_str());
    ImGui::EndTable();
  }
  if (ImGui::CollapsingHeader("Members", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGuiListClipper clipper;
    ImGui::BeginChild("members", ImVec2(0.0f, std::min(9.0f, 1.3f * float(island.bodies.size()) + 0.5f) *
                                                  ImGui::GetFontSize()));
    clipper.Begin(int(island.bodies.size()));
    while (clipper.Step())
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const uint32_t body = island.bodies[size_t(i)];
        char text[96];
        std::snprintf(text, sizeof text, "%s##%u", bodyTitle(world, body).c_str(), body);
        if (entry(text)) edit.selected = selectBody(world, body);
        ImGui::SameLine(12.0f * ImGui::GetFontSize());
        ImGui::TextDisabled("%.3f m/s", double(world.states()[body].linear_velocity.norm()));
      }
    ImGui::EndChild();
  }
  const auto in_island = [&](uint32_t body) { return std::ranges::binary_search(island.bodies, body); };
  if (const auto chosen = neighbours(world, in_island)) edit.selected = chosen;
}

void links(const World& world, const Selection& s, InspectorEdit& edit) {
  if (s.kind != PickKind::Body && s.kind != PickKind::Triangle) return;
  if (const auto island = islandOfBody(world, s.body.index)) {
    if (ImGui::SmallButton(("island " + std::to_string(*island)).c_str())) edit.selected = selectIsland(world, *island);
    ImGui::TextWrapped("%s", explainSleep(world, *island).why.c_str());
  }
  if (s.kind != PickKind::Body) return;
  if (meshOfBody(world, s.body.index) && ImGui::SmallButton("its triangles"))
    edit.selected = selectTriangle(world, s.body.index, 0);
}

}  // namespace

InspectorEdit inspectorSection(const World& world, const Selection& s, pfx::MeshDraw marked) {
  InspectorEdit edit;
  if (s.kind == PickKind::Nothing) {
    ImGui::TextWrapped("Click a body, a contact, a joint or a triangle of a large mesh to see all about it.");
    return edit;
  }
  ImGui::TextUnformatted(titleOf(world, s).c_str());
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - 7.4f * ImGui::GetFontSize());
  if (ImGui::SmallButton("look at")) edit.command = BrowseCommand::Frame;
  ImGui::SameLine();
  if (ImGui::SmallButton("follow")) edit.command = BrowseCommand::Follow;
  ImGui::Separator();
  if (s.kind == PickKind::Island) {
    if (const auto island = islandOfBody(world, s.body.index)) islandFacts(world, *island, edit);
    return edit;
  }
  if (s.kind == PickKind::Triangle) {
    const pfx::LargeMesh& mesh = *meshOfBody(world, s.body.index)->mesh;
    if (const auto next = triangleSteps(world, s, mesh)) edit.selected = next;
    edit.mark = triangleMarks(s, mesh, marked);
  }
  links(world, s, edit);
  const FactSheet facts = factsOf(world, s);
  if (facts.facts.empty()) ImGui::TextDisabled("the two do not touch now");
  if (const auto chosen = factTable("facts", world, facts)) edit.selected = chosen;
  if (s.kind == PickKind::Body)
    if (const auto chosen = neighbours(world, [&](uint32_t body) { return body == s.body.index; }))
      edit.selected = chosen;
  return edit;
}

}  // namespace viewer
