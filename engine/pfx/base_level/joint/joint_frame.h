// Where a joint sits in its two bodies, from world-space points and axes.
#pragma once

#include <optional>

#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/rigid_body/rigid_state.h"

namespace pfx {

// Columns are the joint's x, y and z axis in the world; replaces the axes that the kind asks for.
using JointFrame = std::optional<Mat3>;

// Frame whose x axis is `x` (need not be of unit length; (1, 0, 0) when it is zero) and whose y axis is as
// near to `up` as possible. Without `up`, or with one along x, any frame around x.
Mat3 frameAround(const Vec3& x, const Vec3& up = Vec3::Zero());

// A joint without constraints, placed at a world point with world axes.
Joint placeJoint(JointKind kind, const RigidState& a, const RigidState& b, const Vec3& anchor,
                 const Mat3& frame);

// Fixes axes first .. last at zero; bias 1, weight 1.
void fixAxes(Joint& joint, int first, int last);

// Keeps an axis in a range; a lower limit above the upper one means free.
void limitAxis(AxisConstraint& axis, float lower, float upper);

}  // namespace pfx
