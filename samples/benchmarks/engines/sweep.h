// Speed against error: one accuracy case, run by several solvers with more and more sub-steps.
//
// A frame is always 1/60 s. Ours takes its sub-steps inside a step; the other engines make that many shorter steps, and
// so does ours where nothing touches a body, since it then knows no sub-steps.
// Cost is the processor time of the steps alone, the least of a few repeats, since noise only ever adds; the error is
// the largest of all frames.
#pragma once

#include <string>
#include <vector>

#include "samples/accuracy/case.h"
#include "samples/benchmarks/engines/engine.h"

namespace samples::benchmarks {

struct SweepOptions {
  std::vector<int> substeps = {1, 2, 4, 8, 16, 32, 64};
  int repeats = 3;
  double longest_run = 1.0;  // s of processor time; when a run took longer, finer ones are left out
  bool peers = true;
};

struct SweepPoint {
  int substeps;
  double error;          // signed, in the unit of the case; infinite when the run blew up
  double ns_per_step;    // processor time of a frame
  double ns_per_second;  // of simulated time
};

struct SweepCurve {
  std::string solver;
  std::vector<SweepPoint> points;  // by sub-steps
};

struct Sweep {
  const accuracy::Case* accuracy_case;
  std::vector<SweepCurve> curves;  // ours first
};

Sweep runSweep(const accuracy::Case& accuracy_case, const SweepOptions& options);

}  // namespace samples::benchmarks
