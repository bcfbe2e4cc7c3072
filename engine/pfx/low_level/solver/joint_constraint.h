// One joint to be solved, which of its bodies the solver may move, and by which solver.
#pragma once

#include <cstdint>

#include "pfx/base_level/joint/joint.h"

namespace pfx {

enum class JointSolver : uint8_t {
  Auto,    // chosen by component
  Direct,  // where the factor is not out of all proportion
  Soft,
};

struct JointConstraint {
  Joint* joint = nullptr;
  uint32_t body_a = 0, body_b = 0;  // indices of states
  bool writable_a = false, writable_b = false;

  bool operator==(const JointConstraint&) const = default;
};

}  // namespace pfx
