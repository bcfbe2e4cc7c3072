// Chooses the kernels by processor.
#include "pfx/low_level/solver/joint_kernels.h"

namespace pfx {

const JointKernels& jointKernels(SimdLevel level) {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  return level != SimdLevel::Sse2 && has_avx2 ? kJointKernelsAvx2 : kJointKernelsSse2;
}

}  // namespace pfx
