// The contact kernels for SSE2.
#include "pfx/low_level/solver/contact_kernels_lanes.h"

namespace pfx {

const ContactKernels kContactKernelsSse2 = {PFX_LANES::prepare, PFX_LANES::warmStart,   PFX_LANES::bounce,
                                            PFX_LANES::settle,  PFX_LANES::push,        PFX_LANES::relax,
                                            PFX_LANES::restitution, "sse2"};

}  // namespace pfx
