// Processor time of the calling thread: what a measurement of one thread's work costs, whatever else runs.
#pragma once

#include <time.h>

namespace samples::benchmarks {

inline double processorSeconds() {
  timespec t = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace samples::benchmarks
