// Where bodies are and how they move, in double precision: what references and other engines are compared in.
#pragma once

#include <vector>

#include "pfx/base_level/math/vector_double.h"
#include "pfx/high_level/world/world.h"

namespace samples {

struct BodyMotion {
  pfx::TransformDouble pose;                               // of the centre of mass
  pfx::Vec3d linear_velocity = pfx::Vec3d::Zero();   // m/s
  pfx::Vec3d angular_velocity = pfx::Vec3d::Zero();  // rad/s, world axes
};

inline BodyMotion bodyMotion(const pfx::RigidState& s) {
  return {.pose = pfx::toDouble(s.pose()),
          .linear_velocity = s.linear_velocity.cast<double>(),
          .angular_velocity = s.angular_velocity.cast<double>()};
}

// Of all bodies of a world, by body index.
inline std::vector<BodyMotion> bodyMotions(const pfx::World& world) {
  std::vector<BodyMotion> motions;
  for (const pfx::RigidState& s : world.states()) motions.push_back(bodyMotion(s));
  return motions;
}

}  // namespace samples
