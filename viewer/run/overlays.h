// What can be drawn on top of a scene, by name.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewer {

struct Overlays {
  // Bodies
  bool aabb = false;      // bounds
  bool axes = false;      // local axes at the centres of mass
  bool velocity = false;  // of the centres of mass
  bool trails = false;    // where they were in the last two seconds
  bool inertia = false;   // centre of mass, and the box that has the same mass and inertia
  bool names = false;
  // Contacts
  bool contacts = false;     // points and normals
  bool impulses = false;     // along the normals
  bool friction = false;     // impulses across the normals
  bool penetration = false;  // how deep, by colour, the deepest in figures
  bool features = false;     // which features of the two bodies meet
  bool colours = false;      // by colour of the solver's graph: points of one colour are solved at once
  // Joints
  bool joints = false;  // anchors, frames, arcs of limits
  bool limits = false;  // ranges as fans and cones, and where the joint stands in them
  bool forces = false;  // forces and torques that they carry
  // Islands
  bool islands = false;  // a box and a colour for each island
  bool sleep = false;    // how long it has been still, and why it is awake
  bool solver = false;   // what solves it, and what is left of its errors
  // Large meshes, as far as they are in the picture
  bool mesh_islands = false;    // a box for each island
  bool mesh_edges = false;      // coloured by kind
  bool mesh_boxes = false;      // bounds of each triangle
  bool mesh_normals = false;
  bool mesh_thickness = false;  // lower faces and sides
  // Particles
  bool particles = false;  // free, held, part of a body
  bool links = false;      // distances that are kept, by strain
  bool bends = false;      // angles that are kept
  bool volumes = false;    // tetrahedra that keep their volume
  // Whole scene
  bool world = false;          // the world box
  bool tree = false;           // boxes of the trees that find pairs, by level, or the extents along the sweep's axis
  bool probe = false;          // what a ray, a swept ball and an overlap find under the mouse
  bool selection_only = false;  // all of the above only for what is selected

  bool operator==(const Overlays&) const = default;
};

struct OverlayInfo {
  std::string_view name;  // on the command line
  const char* group;      // heading in the panel
  const char* label;
  const char* help;
  bool Overlays::*flag;
};
// All of them; those of a group in a row.
std::span<const OverlayInfo> overlayTable();

// "aabb, axes, ...": all names.
std::string overlayNames();

// "aabb,axes": the ones that are on, as parseOverlays reads them; "none" for none.
std::string overlayList(const Overlays& overlays);

// From a list such as "contacts,islands"; "all" (everything that can be drawn) and "none" are understood. Throws
// InputError naming what is unknown.
Overlays parseOverlays(const std::string& list);

}  // namespace viewer
