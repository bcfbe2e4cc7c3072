// The bodies of a world: parallel arrays by body index, with handles that notice removal.
#pragma once

#include <span>
#include <string>

#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/high_level/world/world.h"
#include "pfx/low_level/broadphase/dynamic_tree.h"

namespace pfx {

struct BodyStore {
  Vector<RigidState> states;
  Vector<RigidBody> bodies;
  Vector<Collidable> collidables;
  Vector<Inertia> inertias;
  Vector<float> size;    // m, smallest half extent: the length that contact margins are measured by
  Vector<float> radius;  // m, about the centre of mass
  Vector<String> names;
  Vector<Surface> surfaces;  // by body, up to the last one that has any
  Vector<uint32_t> generations;  // odd while the body exists
  Vector<uint32_t> free_slots;
  Deque<Vector<Shape>> shapes;  // by body; addresses stay, collidables point here
  Deque<DynamicTree> shape_trees;    // by body; empty for bodies of few shapes

  // Throws std::invalid_argument naming the body and the field.
  BodyId add(const BodyDef& def);
  void remove(uint32_t index);
  Surface surface(uint32_t index) const { return index < surfaces.size() ? surfaces[index] : Surface{}; }
  void setSurface(uint32_t index, const Surface& surface);  // throws std::invalid_argument naming the body
  void attachShapes(uint32_t index, Collidable& collidable);  // has it refer to shapes[index]
  // Throws std::invalid_argument, and changes nothing, for no shape or one that is not valid.
  void setShapes(uint32_t index, std::span<const Shape> new_shapes);
  bool isValid(BodyId id) const {
    return id.index < generations.size() && generations[id.index] == id.generation;
  }
  bool exists(uint32_t index) const { return generations[index] % 2 == 1; }
  uint32_t count() const { return static_cast<uint32_t>(states.size() - free_slots.size()); }
};

}  // namespace pfx
