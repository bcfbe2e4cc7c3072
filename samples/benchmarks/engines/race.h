// Runs one benchmark scene in several engines at once and compares time and error.
//
// Wall time and the processor time of the calling thread are both taken: the latter is what a loaded machine leaves
// comparable. The engines take turns in blocks of a few steps, in alternating order, so that a slow phase of the machine
// hits all of them; times are compared block by block and the median of those ratios is the figure to trust.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "samples/benchmarks/engines/engine.h"
#include "samples/benchmarks/scenes.h"

namespace samples::benchmarks {

// Median and quartiles.
struct Spread {
  double median = 0.0, lower = 0.0, upper = 0.0;
};
Spread spread(std::vector<double> values);

struct Result {
  std::string engine;
  bool supported = true;        // false: the engine cannot run the scene, and nothing below holds
  Spread ms_per_step;           // wall time
  Spread cpu_ms;                // processor time of the calling thread, a step
  Spread ratio;                 // of the processor time to that of the first contestant, or of the wall
                                // time where one of both has several threads; above 1 is slower
  double worst_ms = 0.0;        // slowest step
  double kinetic_energy = 0.0;  // J, at the end
  double largest_drift = 0.0;   // m, farthest that any body ended from where it began
  double lowest = 0.0;  // m, lowest centre of a body that is not fixed: far below the floor, it was lost
};

// ours: pfx with this number of workers.
EngineKind pfxEngine(const Case& scene, int workers);

// Runs `steps` steps of the scene in every contestant; the first is the one that others are compared with.
std::vector<Result> race(const Case& scene, std::span<const EngineKind> contestants, int steps);

}  // namespace samples::benchmarks
