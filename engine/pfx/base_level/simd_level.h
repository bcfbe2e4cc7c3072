// Instruction sets that kernels are compiled for.
#pragma once

#include <cstdint>

namespace pfx {

enum class SimdLevel : uint8_t {
  Auto,  // the widest that the processor runs
  Sse2,
  Avx2,
};

}  // namespace pfx
