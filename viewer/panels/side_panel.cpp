// Counters, overlays, solver settings and the selection.
#include <array>
#include <cmath>

#include "viewer/panels/window.h"

namespace viewer {

namespace {

// A row of a two-column table: what, value.
template <class... Args>
void row(const char* what, const char* format, Args... args) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
  ImGui::TableNextColumn();
  ImGui::Text(format, args...);
}

void vectorRow(const char* what, const pfx::Vec3& v, const char* unit) {
  row(what, "%.3f %.3f %.3f %s", double(v.x()), double(v.y()), double(v.z()), unit);
}

bool beginFacts(const char* id) {
  return ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg);
}

bool section(const char* title, bool open = true) {
  return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

const char* motionName(pfx::MotionType type) {
  static constexpr std::array<const char*, pfx::kNumMotionTypes> kNames = {"fixed", "active", "keyframe",
                                                                           "one way", "trigger"};
  const auto i = size_t(type);
  return i < kNames.size() ? kNames[i] : "unknown";
}

const char* shapeName(const pfx::Shape& shape) {
  static constexpr std::array<const char*, pfx::kNumShapeTypes> kNames = {
      "sphere", "box", "capsule", "cylinder", "convex mesh", "large mesh"};
  return kNames[size_t(shape.type())];
}

}  // namespace

void countersSection(const Session& session) {
  const Figures& f = session.figures();
  const pfx::WorldCounts& c = f.counts;
  if (!beginFacts("counters")) return;
  row("bodies", "%u, %u awake", c.bodies, c.awake);
  row("pairs", "%u, %u touching", c.pairs, c.touching_pairs);
  row("contact points", "%u", c.contact_points);
  row("islands", "%u", c.islands);
  row("joints", "%u", c.joints);
  row("kinetic energy", "%.4g J", f.kinetic_energy);
  row("potential energy", "%.4g J", f.potential_energy);
  row("deepest overlap", "%.3f mm", 1000.0 * f.max_penetration);
  row("joint error", "%.3f mm", 1000.0 * f.max_joint_error);
  row("fastest body", "%.3f m/s", f.max_speed);
  ImGui::EndTable();
  const auto plot = [](const char* id, const std::vector<float>& values, const char* label) {
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 2.6f * ImGui::GetFontSize());
    ImGui::PlotLines(id, values.data(), int(values.size()), 0, label, FLT_MAX, FLT_MAX, size);
  };
  plot("##energy", session.energies(), "energy");
  plot("##penetration", session.penetrations(), "overlap");
}

void overlaysSection(Overlays& o) {
  ImGui::Columns(2, "overlays", false);
  ImGui::Checkbox("bounds", &o.aabb);
  ImGui::Checkbox("axes", &o.axes);
  ImGui::Checkbox("contacts", &o.contacts);
  ImGui::Checkbox("islands", &o.islands);
  ImGui::NextColumn();
  ImGui::Checkbox("joints", &o.joints);
  ImGui::Checkbox("velocities", &o.velocity);
  ImGui::Checkbox("world box", &o.world);
  ImGui::Columns(1);
}

bool solverSection(RunSettings& settings, const pfx::WorldDef& def) {
  bool changed = false;
  int substeps = settings.substeps.value_or(def.substeps);
  if (ImGui::SliderInt("sub-steps", &substeps, 1, 32)) {
    settings.substeps = substeps;
    changed = true;
  }
  changed |= ImGui::SliderInt("threads", &settings.threads, 1, 8);
  float hertz = 1.0f / settings.dt;
  if (ImGui::SliderFloat("steps a second", &hertz, 15.0f, 480.0f, "%.0f Hz", ImGuiSliderFlags_Logarithmic)) {
    settings.dt = 1.0f / std::round(hertz);
    changed = true;
  }
  ImGui::TextDisabled("a change starts the scene again");
  return changed;
}

void bodySection(const pfx::World& world, uint32_t body) {
  if (body >= world.states().size() || !world.bodyId(body)) {
    ImGui::TextDisabled("the body is gone");
    return;
  }
  const pfx::RigidState& s = world.states()[body];
  const pfx::RigidBody& b = world.bodies()[body];
  const std::string_view body_name = world.name(body);
  if (!beginFacts("body")) return;
  row("name", "%.*s", int(body_name.size()), body_name.data());
  row("index", "%u", body);
  row("motion", "%s%s", motionName(s.motion_type), s.asleep ? ", asleep" : "");
  for (const pfx::Shape& shape : world.collidables()[body].shapes()) row("shape", "%s", shapeName(shape));
  vectorRow("position", s.position, "m");
  const pfx::Quat& q = s.orientation;
  row("orientation", "%.3f %.3f %.3f %.3f", double(q.x()), double(q.y()), double(q.z()), double(q.w()));
  vectorRow("velocity", s.linear_velocity, "m/s");
  vectorRow("angular velocity", s.angular_velocity, "rad/s");
  row("mass", "%.4g kg", double(b.mass));
  vectorRow("inertia", b.inertia.diagonal(), "kg m2");
  row("friction", "%.3f", double(b.friction));
  row("restitution", "%.3f", double(b.restitution));
  row("damping", "%.3f, %.3f 1/s", double(b.linear_damping), double(b.angular_damping));
  row("still for", "%u steps", s.sleep_count);
  row("filter", "%08x of %08x", s.filter_self, s.filter_target);
  ImGui::EndTable();
}

std::optional<uint32_t> islandSection(const pfx::World& world, uint32_t selected) {
  std::optional<uint32_t> chosen;
  if (!ImGui::BeginTable("islands", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY, ImVec2(0.0f, 150.0f)))
    return chosen;
  for (const char* column : {"island", "bodies", "contacts", "still"}) ImGui::TableSetupColumn(column);
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(int(world.numIslands()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const pfx::IslandView island = world.island(uint32_t(i));
      const uint32_t id = pickId(PickKind::Island, uint32_t(i));
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      char text[16];
      std::snprintf(text, sizeof text, "%d", i);
      if (ImGui::Selectable(text, selected == id, ImGuiSelectableFlags_SpanAllColumns)) chosen = id;
      ImGui::TableNextColumn();
      ImGui::Text("%zu", island.bodies.size());
      ImGui::TableNextColumn();
      ImGui::Text("%zu", island.contacts.size());
      ImGui::TableNextColumn();
      island.asleep ? ImGui::TextUnformatted("asleep") : ImGui::Text("%.2f s", double(island.sleep_timer));
    }
  ImGui::EndTable();
  return chosen;
}

SideEdit sidePanel(const PanelArea& area, const Session& session, const SideState& state) {
  SideEdit edit;
  const PanelWindow window("Inspector", area);
  ImGui::TextWrapped("%s", session.spec().shows.c_str());
  ImGui::Spacing();
  if (section("Selection")) {
    if (pickKind(state.selected) == PickKind::Body)
      bodySection(session.world(), pickIndex(state.selected));
    else
      ImGui::TextDisabled("click a body to see what it is");
  }
  if (section("Overlays")) overlaysSection(*state.overlays);
  if (section("Figures")) countersSection(session);
  if (section("Islands", false)) edit.selected = islandSection(session.world(), state.selected);
  if (section("Solver", false)) edit.restart = solverSection(*state.settings, session.world().def());
  return edit;
}

}  // namespace viewer
