// The choice of kernels on a processor that has no AVX2, in place of the engine's own choice.
#include "pfx/low_level/solver/contact_kernels.h"

namespace pfx {

const ContactKernels& contactKernels(SimdLevel) { return kContactKernelsSse2; }

}  // namespace pfx
