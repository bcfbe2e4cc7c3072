// The primitive shapes. Sizes are half extents and half lengths in metres; capsule and cylinder lie along local X.
#pragma once

#include "pfx/base_level/math/vector.h"

namespace pfx {

struct Sphere {
  float radius = 1.0f;  // m
};

struct Box {
  Vec3 half_extent = Vec3::Ones();  // m
};

struct Capsule {
  float half_length = 1.0f;  // m, of the core segment along local X (the caps come on top)
  float radius = 1.0f;       // m
};

struct Cylinder {
  float half_length = 1.0f;  // m, along local X
  float radius = 1.0f;       // m
};

}  // namespace pfx
