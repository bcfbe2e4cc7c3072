// A ragdoll: eleven bodies, ten joints, 61 kg, 3.3 m tall, facing +Z with its arms stretched out.
#pragma once

#include <array>
#include <string>

#include "pfx/high_level/world/world.h"

namespace samples {

struct Ragdoll {
  enum Part {
    Pelvis,
    Torso,
    Head,
    UpperLegL,
    UpperLegR,
    LowerLegL,
    LowerLegR,
    UpperArmL,
    UpperArmR,
    LowerArmL,
    LowerArmR
  };
  std::array<pfx::BodyId, 11> bodies;  // by Part
  std::array<pfx::JointId, 10> joints;
  std::array<pfx::JointId, 4> hinges;  // knees and elbows: 0 .. 1.57 rad
};

// `pose`: of the pelvis; the soles are 1.85 m below it. inertia_scale: on every moment of inertia.
Ragdoll addRagdoll(pfx::World& world, const std::string& name, const pfx::Transform& pose,
                   float inertia_scale = 3.0f);

}  // namespace samples
