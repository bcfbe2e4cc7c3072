// Chooses the kernels by processor.
#include "pfx/low_level/solver/contact_kernels.h"

namespace pfx {

const ContactKernels& contactKernels(SimdLevel level) {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  return level != SimdLevel::Sse2 && has_avx2 ? kContactKernelsAvx2 : kContactKernelsSse2;
}

}  // namespace pfx
