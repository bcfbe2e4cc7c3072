// The velocity with which a character goes where it wants among bodies that do not give way: collide and
// slide, with steps taken and steep ground treated as a wall. Bodies that give way are left to the solver.
#pragma once

#include "pfx/high_level/character/character_probe.h"

namespace pfx {

struct GroundMotion {
  Vec3 velocity = Vec3::Zero();  // m/s
  bool climbs = false;           // a step is being taken
};

// `wanted`: m/s, along the ground and against it; `ground`: m/s, of the ground itself. The result holds for
// one step of dt seconds and keeps the feet on the ground.
GroundMotion planGroundMotion(const CharacterProbe& probe, const CharacterParams& params, const Vec3& wanted,
                              const Vec3& ground, float dt);

// `v` turned into the plane with that normal (unit, y > 0): same horizontal direction, same length.
Vec3 alongGround(const Vec3& v, const Vec3& normal);

// `v` shortened to `limit`.
Vec3 clampedTo(const Vec3& v, float limit);

}  // namespace pfx
