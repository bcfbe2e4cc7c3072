// Quality probes: small hard scenes, each with the one thing that goes wrong in it, measured.
//
// The scenes and the figures beside them are those of a survey of Box3D (version 0.1.0 at its defaults, 60 Hz and 4
// sub-steps), so that both can be read side by side. Bodies sleep below 0.05 m/s after half a second, as there.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace samples::benchmarks {

struct Probe {
  std::string_view name;
  std::string (*run)(int substeps);  // what happened, with its figures
  std::string_view survey;           // what the survey saw at 4 sub-steps
};

std::span<const Probe> probes();

// Families of probes, in the order of the table.
std::span<const Probe> restProbes();
std::span<const Probe> motionProbes();

}  // namespace samples::benchmarks
