#include "viewer/bench/probe_report.h"

#include <cstdio>

#include "samples/benchmarks/probes.h"

namespace viewer {

nlohmann::ordered_json runProbes() {
  auto json = nlohmann::ordered_json::array();
  std::printf("quality probes, 60 Hz; beside them a survey of Box3D 0.1.0 at 4 sub-steps\n");
  for (const samples::benchmarks::Probe& probe : samples::benchmarks::probes()) {
    const std::string at4 = probe.run(4), at8 = probe.run(8);
    std::printf("  %s\n    4 sub-steps: %s\n    8 sub-steps: %s\n    survey:      %s\n", std::string(probe.name).c_str(),
                at4.c_str(), at8.c_str(), std::string(probe.survey).c_str());
    std::fflush(stdout);
    json.push_back({{"probe", probe.name}, {"substeps_4", at4}, {"substeps_8", at8}, {"survey", probe.survey}});
  }
  std::printf("\n");
  return json;
}

}  // namespace viewer
