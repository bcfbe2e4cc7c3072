// What is selected in the browser, named so that it stays the same thing from step to step: pairs and islands are
// numbered anew in every step, bodies, joints and triangles are not.
#pragma once

#include "viewer/draw_list/draw_list.h"
#include "viewer/inspect/mesh_facts.h"

namespace viewer {

struct Selection {
  PickKind kind = PickKind::Nothing;
  pfx::BodyId body = {};   // Body, Triangle; the first of a Contact; the lowest of an Island
  pfx::BodyId other = {};  // the second of a Contact
  pfx::JointId joint = {}; // Joint
  uint32_t facet = 0;   // Triangle: index in the large mesh of the body

  bool operator==(const Selection&) const = default;
};

Selection selectBody(const pfx::World& world, uint32_t body);
Selection selectTriangle(const pfx::World& world, uint32_t body, uint32_t facet);
Selection selectContact(const pfx::World& world, const pfx::Pair& pair);
Selection selectJoint(const pfx::World& world, uint32_t joint);
Selection selectIsland(const pfx::World& world, uint32_t island);
// What a pick id means in this world; `ray` finds the triangle of a large mesh.
Selection selectPicked(const pfx::World& world, uint32_t id, const Ray& ray);

// Nothing when it is gone.
Selection stillThere(const pfx::World& world, const Selection& selection);
// The pick id that it has now, for an outline; 0 when nothing is to be outlined.
uint32_t pickOf(const pfx::World& world, const Selection& selection);
// "box 12", "triangle 24 of landscape", "box 3 on ground": short, for the title of the window.
std::string titleOf(const pfx::World& world, const Selection& selection);
// All that is known of it.
FactSheet factsOf(const pfx::World& world, const Selection& selection);
// The bodies that it is made of; of a triangle that of its mesh.
std::vector<uint32_t> bodiesOf(const pfx::World& world, const Selection& selection);
// Where to look to see it; empty for nothing.
pfx::Aabb boundsOf(const pfx::World& world, const Selection& selection);

}  // namespace viewer
