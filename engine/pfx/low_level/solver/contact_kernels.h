// The contact solver's inner loops, chosen once by processor.
//
// Each function works through a range of batches (8 manifolds each) that share no writable body. Method:
// sequential impulses with soft rows (constraint/softness.h), normals first, then friction in a circular cone
// about the current normal impulse.
#pragma once

#include <cstdint>

#include "pfx/base_level/constraint/contact_rows.h"
#include "pfx/base_level/constraint/solver_body.h"
#include "pfx/base_level/simd_level.h"

namespace pfx {

struct ContactKernels {
  using Fn = void (*)(ContactRows* rows, uint32_t count, SolverBody* bodies,
                      const ContactSolveParams& params);
  Fn prepare;      // makes rows of what the set-up copied; SolverBody::dq holds the orientation meanwhile
  Fn warm_start;   // applies the impulses in the rows
  Fn bounce;       // impacts within the sub-step to come, of lanes that bounce in order; before forces
  Fn settle;       // new contacts only: finds their impulses before anything moves
  Fn push;         // normal rows with bias: overlap is pushed out softly, gaps may close
  Fn relax;        // normal rows without push, then friction
  Fn restitution;  // rows that took an impact leave with restitution times the approach speed
  const char* name;
};

// The kernels for `level`; Auto and unsupported levels give the best that this processor runs.
const ContactKernels& contactKernels(SimdLevel level = SimdLevel::Auto);

extern const ContactKernels kContactKernelsSse2;
extern const ContactKernels kContactKernelsAvx2;

}  // namespace pfx
