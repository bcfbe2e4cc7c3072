// Distance between two convex cores: the algorithm of Gilbert, Johnson and Keerthi (IEEE J. Robotics and
// Automation 4(2), 1988), with the simplex in double precision.
#pragma once

#include "pfx/base_level/collision/convex_core.h"
#include "pfx/base_level/collision/local_manifold.h"

namespace pfx {

struct GjkInput {
  const ConvexCore& a;
  const ConvexCore& b;
  const RelativePose& b_in_a;
  Vec3 direction =
      Vec3::Zero();     // first guess of the axis from A to B, frame of A; zero: from centre to centre
  float limit = 1e30f;  // m; the search stops as soon as the cores are known to be farther apart
};

struct GjkResult {
  enum class State : uint8_t {
    Separated,    // distance, normal and points are those of the closest points
    BeyondLimit,  // distance is a lower bound above the limit, along normal; points are not set
    Touching,     // the cores meet; nothing else is set
  };
  State state = State::Touching;
  float distance = 0.0f;        // m, between the cores
  Vec3 normal = Vec3::UnitY();  // unit, from A to B, frame of A
  Vec3 point_a = Vec3::Zero();  // m, frame of A
  Vec3 point_b = Vec3::Zero();  // m, frame of A
  int iterations = 0;
};

GjkResult gjkDistance(const GjkInput& input);

}  // namespace pfx
