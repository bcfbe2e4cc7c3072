// Turns of a gear's bodies, however fast they turn: a pose alone does not tell how often a body has turned round.
#pragma once

#include "pfx/base_level/joint/joint_coordinates.h"

namespace pfx {

// The turns, by whole turns nearest to `near`, which must be right to less than half a turn.
GearAngles gearAnglesNear(const Joint& joint, const TransformDouble& a, const TransformDouble& b, const GearAngles& near);

// Axis 3 of a gear, rad.
double gearCoordinate(const Joint& joint, const GearAngles& angles);

// How fast the bodies turn about the axes of the gear, rad/s. wa, wb: world axes.
GearAngles gearRates(const Joint& joint, const TransformDouble& a, const Vec3d& wa, const TransformDouble& b,
                     const Vec3d& wb);

}  // namespace pfx
