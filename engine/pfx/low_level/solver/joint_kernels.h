// The soft joint solver's inner loops, chosen once by processor: sequential impulses over batches of eight
// joints that share no writable body.
#pragma once

#include "pfx/base_level/constraint/joint_rows.h"
#include "pfx/base_level/constraint/solver_body.h"
#include "pfx/base_level/simd_level.h"

namespace pfx {

struct JointKernels {
  using Fn = void (*)(JointBatch* batches, uint32_t count, JointAxisRows* rows, SolverBody* bodies,
                      const JointSolveParams& params);
  Fn warm_start;  // applies the impulses in the batches
  Fn follow;      // turns the torques of impulses that bodies still have from the last sub-step with the levers
  Fn push;        // with position errors
  Fn relax;       // velocities alone
};

// The kernels for `level`; Auto and unsupported levels give the best that this processor runs.
const JointKernels& jointKernels(SimdLevel level = SimdLevel::Auto);

extern const JointKernels kJointKernelsSse2;
extern const JointKernels kJointKernelsAvx2;

}  // namespace pfx
