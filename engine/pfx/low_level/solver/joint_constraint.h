// One joint to be solved, and which of its bodies the solver may move.
#pragma once

#include <cstdint>

#include "pfx/base_level/joint/joint.h"

namespace pfx {

struct JointConstraint {
  Joint* joint = nullptr;
  uint32_t body_a = 0, body_b = 0;  // indices of states
  bool writable_a = false, writable_b = false;

  bool operator==(const JointConstraint&) const = default;
};

}  // namespace pfx
