// Where body B stands in the joint frame of body A, axis by axis, and how fast each of these numbers changes.
//
// Axes 0 .. 2: anchor B - anchor A along the axes of frame A; a distance joint has the distance of the
// anchors as its axis 0. Axes 3 .. 5: the rotation of frame B seen from frame A is split into a twist about x
// and a swing about an axis in the y-z plane (swing * twist); axis 3 is the twist angle, 4 and 5 are the
// components of the swing's rotation vector, or axis 4 its angle when the joint has a cone. A gear has ratio
// * angle A + angle B as its axis 3.
//
// The rate of the twist angle is exact, (xA + xB) . w / (1 + xA . xB); those of the swing are exact for a
// swing about one axis, and to first order otherwise. Source of the split: P. Dobrowolski, Swing-twist
// decomposition in Clifford algebra, 2015.
#pragma once

#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/math/vector_double.h"

namespace pfx {

struct JointCoordinates {
  double value[kNumJointAxes];  // m, rad
};

// Row i: rate of coordinate i = a[i] . (vA, wA) + b[i] . (vB, wB), world axes, velocities of the centres of
// mass.
struct JointJacobian {
  double a[kNumJointAxes][6];
  double b[kNumJointAxes][6];
};

JointCoordinates measureJoint(const Joint& joint, const TransformDouble& a, const TransformDouble& b);

struct JointLinearization {
  JointCoordinates coordinates;
  JointJacobian jacobian;
};
JointLinearization linearizeJoint(const Joint& joint, const TransformDouble& a, const TransformDouble& b);

// How far an axis with value `x` is outside of what it allows (signed; 0 inside the range and for free axes).
double axisError(const AxisConstraint& axis, double x);

struct JointError {
  double distance;  // m, length of the error of the translations
  double angle;     // rad, likewise of the rotations
};
JointError jointError(const Joint& joint, const TransformDouble& a, const TransformDouble& b);

// Turns of a gear's bodies, counted on from the angles in the joint (no more than half a turn since then).
struct GearAngles {
  double a, b;  // rad
};
GearAngles gearAngles(const Joint& joint, const TransformDouble& a, const TransformDouble& b);

}  // namespace pfx
