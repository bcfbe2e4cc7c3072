// Counts every allocation of a test program that compiles counted_allocations.cpp, which replaces the global operator new.
#pragma once

#include <atomic>

namespace support {

extern std::atomic<long> g_allocations;

}  // namespace support
