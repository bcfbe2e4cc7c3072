// The joint kernels for AVX2.
#include "pfx/low_level/solver/joint_kernels_lanes.h"

namespace pfx {

const JointKernels kJointKernelsAvx2 = {PFX_LANES::warmStartJoints, PFX_LANES::followLevers, PFX_LANES::pushJoints,
                                        PFX_LANES::relaxJoints};

}  // namespace pfx
