// Dragging a body by one of its points, as with a mouse: a ball joint of limited force towards a point that
// moves.
#pragma once

#include "pfx/high_level/world/world.h"

namespace pfx {

class BodyDrag {
 public:
  // Takes hold of `body` at a world point. strength: largest acceleration (m/s^2) that the force could give
  // the body alone. Throws std::invalid_argument when the body does not exist or is not dynamic. Lets go of
  // what it held before.
  void begin(World& world, BodyId body, const Vec3& point, float strength = 120.0f);

  // Where the point is to go, in the world. Nothing happens when nothing is held, or the body was removed.
  void move(World& world, const Vec3& target);

  void end(World& world);
  bool isHolding(const World& world) const { return world.isValid(joint_); }

 private:
  BodyId hand_;  // a fixed body without contacts, kept from drag to drag
  JointId joint_;
};

}  // namespace pfx
