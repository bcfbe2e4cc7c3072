// When two moving shapes first touch: conservative advancement.
//
// The distance between the shapes, divided by a bound of the speed at which it can shrink, is a time that is safe to
// skip; skipping it again and again comes as close to the impact as one likes and never beyond. Rotation enters through
// the bound, so that nothing is missed, whatever turns and however fast.
// Source: B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, section 2.3.
#pragma once

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

// Motion of a body at constant velocity over one interval, fractions 0 .. 1.
struct Sweep {
  Transform start;                // body to world
  Vec3 motion = Vec3::Zero();     // m, of the body's origin over the whole interval
  Vec3 rotation = Vec3::Zero();   // rad, world axes, over the whole interval

  Transform at(float fraction) const;
};

struct ImpactInput {
  const Shape& shape_a;  // one of the two may be a large mesh
  const Sweep& sweep_a;
  const Shape& shape_b;
  const Sweep& sweep_b;
  float tolerance = 1e-4f;     // m, > 0; shapes this close count as touching
  float max_fraction = 1.0f;   // look no further
};

struct Impact {
  enum class State : uint8_t {
    Apart,     // they stay apart up to max_fraction
    Hit,       // they come within the tolerance at `fraction` and not before
    Overlaps,  // they touch or overlap at the start; fraction is 0, normal and point are not set when they overlap
  };
  State state = State::Apart;
  float fraction = 1.0f;
  Vec3 normal = Vec3::Zero();   // unit, world, from A to B
  Vec3 point = Vec3::Zero();    // m, world, at most the tolerance away from both
  uint32_t triangle = kNoFacet; // facet of a large mesh

  bool touches() const { return state != State::Apart; }
};

// First touch of two shapes; none for missing meshes and for sweeps that are not finite. A facet of a large mesh stops only what comes from its front: a shape whose centre starts
// behind it by more than the facet's thickness passes. A hit that the shapes already move away from does not count.
Impact timeOfImpact(const ImpactInput& input);

}  // namespace pfx
