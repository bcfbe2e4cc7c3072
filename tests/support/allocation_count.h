// How many allocations the process has made, if a file of the program includes counted_allocations.h.
#pragma once

#include <atomic>

namespace support {

inline std::atomic<long> g_allocations{0};

}  // namespace support
