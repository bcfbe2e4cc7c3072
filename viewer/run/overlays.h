// What can be drawn on top of a scene, by name.
#pragma once

#include <string>
#include <string_view>

namespace viewer {

struct Overlays {
  bool aabb = false;      // bounds of bodies
  bool axes = false;      // local axes at the centres of mass
  bool contacts = false;  // points, normals, impulses
  bool islands = false;   // a box and a colour for each island
  bool joints = false;    // anchors and frames
  bool velocity = false;  // of the centres of mass
  bool world = false;     // the world box

  bool operator==(const Overlays&) const = default;
};

// "aabb, axes, ...": all names.
std::string overlayNames();

// "aabb,axes": the ones that are on, as parseOverlays reads them; "none" for none.
std::string overlayList(const Overlays& overlays);

// From a list such as "contacts,islands"; "all" and "none" are understood. Throws InputError naming what is
// unknown.
Overlays parseOverlays(const std::string& list);

}  // namespace viewer
