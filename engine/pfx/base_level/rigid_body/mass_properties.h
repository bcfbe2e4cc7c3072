// Mass, centre of mass and inertia of shapes: closed forms for primitives, exact integrals for meshes, sums
// for compounds.
#pragma once

#include <optional>
#include <span>

#include "pfx/base_level/shape/shape.h"

namespace pfx {

struct MassProperties {
  float mass = 0.0f;           // kg
  Vec3 center = Vec3::Zero();  // m, centre of mass
  Mat3 inertia =
      Mat3::Zero();  // kg m^2, about the centre of mass, in the axes of the frame the shape is given in
};

// Of one geometry in its own frame, filled with `density` kg/m^3. Overlapping parts of a compound count
// twice. A large mesh is a surface: its mass is zero. Formulas: any table of moments of inertia; meshes by
// exact integration.
MassProperties massProperties(const Geometry& geometry, float density);

// Of one shape in the body frame.
MassProperties massProperties(const Shape& shape, float density);

// Of all shapes together, in the body frame (parallel-axis theorem, summed in double precision).
MassProperties massProperties(std::span<const Shape> shapes, float density);

// The same distribution of matter with another total mass (kg). Nothing when the old mass is zero or the new
// one is not positive and finite.
std::optional<MassProperties> scaledToMass(const MassProperties& properties, float mass);

}  // namespace pfx
