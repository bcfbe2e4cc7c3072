// Check boxes of what is drawn on top of the scene.
#include "viewer/panels/window.h"

namespace viewer {

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

}  // namespace viewer
