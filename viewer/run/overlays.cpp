// The table of overlay names.
#include "viewer/run/overlays.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "viewer/input_error.h"

namespace viewer {
namespace {

constexpr std::string_view kSelectionOnly = "selection";

constexpr std::array kTable = {
    OverlayInfo{"aabb", "Bodies", "bounds", "boxes along the world's axes", &Overlays::aabb},
    OverlayInfo{"axes", "Bodies", "axes", "body axes at the centre of mass: x red, y green, z blue", &Overlays::axes},
    OverlayInfo{"velocity", "Bodies", "velocities", "the way of a quarter of a second", &Overlays::velocity},
    OverlayInfo{"trails", "Bodies", "trajectories", "the way of the last two seconds", &Overlays::trails},
    OverlayInfo{"inertia", "Bodies", "mass", "centre of mass, and the box of the same mass and inertia",
                &Overlays::inertia},
    OverlayInfo{"names", "Bodies", "names", "names of the bodies", &Overlays::names},
    OverlayInfo{"contacts", "Contacts", "points", "points and normals of both bodies", &Overlays::contacts},
    OverlayInfo{"impulses", "Contacts", "impulses", "of the last step, along the normals", &Overlays::impulses},
    OverlayInfo{"friction", "Contacts", "friction", "impulses of friction on the second body", &Overlays::friction},
    OverlayInfo{"penetration", "Contacts", "overlap", "how deep: green 0, red 1 mm and more; figures for the deepest",
                &Overlays::penetration},
    OverlayInfo{"features", "Contacts", "features", "names of the pair of features that meets", &Overlays::features},
    OverlayInfo{"colours", "Contacts", "graph colour", "points of one colour are solved at once", &Overlays::colours},
    OverlayInfo{"joints", "Joints", "frames", "anchors, frames and ranges", &Overlays::joints},
    OverlayInfo{"limits", "Joints", "limits", "ranges as fans and cones, the needle shows where the joint stands",
                &Overlays::limits},
    OverlayInfo{"forces", "Joints", "forces", "force (blue) and torque (violet) on the second body",
                &Overlays::forces},
    OverlayInfo{"islands", "Islands", "colours", "a box and a colour for each island", &Overlays::islands},
    OverlayInfo{"sleep", "Islands", "why awake", "how long each has been still, and what keeps it awake",
                &Overlays::sleep},
    OverlayInfo{"solver", "Islands", "solver", "what solves it, deepest overlap and widest joint", &Overlays::solver},
    OverlayInfo{"mesh_islands", "Large meshes", "islands", "a box for each island of a mesh", &Overlays::mesh_islands},
    OverlayInfo{"mesh_edges", "Large meshes", "edges", "by kind: flat grey, convex amber, concave blue, open red",
                &Overlays::mesh_edges},
    OverlayInfo{"mesh_boxes", "Large meshes", "facet boxes", "bounds of each triangle", &Overlays::mesh_boxes},
    OverlayInfo{"mesh_normals", "Large meshes", "normals", "of each triangle", &Overlays::mesh_normals},
    OverlayInfo{"mesh_thickness", "Large meshes", "thickness", "how far behind its face each triangle is solid",
                &Overlays::mesh_thickness},
    OverlayInfo{"particles", "Particles", "particles", "free blue, held red, part of a body violet", &Overlays::particles},
    OverlayInfo{"links", "Particles", "links", "distances that are kept: green at rest, red where the strain is largest",
                &Overlays::links},
    OverlayInfo{"bends", "Particles", "bends", "angles that are kept", &Overlays::bends},
    OverlayInfo{"volumes", "Particles", "volumes", "tetrahedra that keep their volume", &Overlays::volumes},
    OverlayInfo{"tree", "Scene", "pair search", "boxes of the trees that find pairs, by level, or extents along the sweep",
                &Overlays::tree},
    OverlayInfo{"probe", "Scene", "probe", "what a ray, a swept ball and an overlap find under the mouse",
                &Overlays::probe},
    OverlayInfo{"world", "Scene", "world box", "the box of the world", &Overlays::world},
    OverlayInfo{kSelectionOnly, "Scene", "selection only", "draw all of this only for what is selected",
                &Overlays::selection_only},
};

}  // namespace

std::span<const OverlayInfo> overlayTable() { return kTable; }

std::string overlayNames() {
  std::string names;
  for (const OverlayInfo& e : kTable) names += (names.empty() ? "" : ", ") + std::string(e.name);
  return names;
}

std::string overlayList(const Overlays& overlays) {
  std::string names;
  for (const OverlayInfo& e : kTable)
    if (overlays.*e.flag) {
      if (!names.empty()) names += ',';
      names += e.name;
    }
  return names.empty() ? "none" : names;
}

Overlays parseOverlays(const std::string& list) {
  Overlays out;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    if (part.empty() || part == "none") continue;
    bool known = part == "all";
    for (const OverlayInfo& e : kTable)
      if (part == e.name || (part == "all" && e.name != kSelectionOnly)) out.*e.flag = true, known = true;
    if (!known)
      throw InputError("--overlay \"" + list + "\": \"" + part + "\" is not known; known: " + overlayNames());
  }
  return out;
}

}  // namespace viewer
