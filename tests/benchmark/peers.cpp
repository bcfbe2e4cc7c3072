// Races pfx against the other engines that are installed. peers [CASE...] [--steps N]
//
// Prints, for each scene and engine, time a step (median and quartiles), the ratio to pfx, and what came out.
#include <charconv>
#include <cstdio>
#include <cstring>

#include "samples/benchmarks/race.h"

namespace bench = samples::benchmarks;

namespace {

struct Arguments {
  std::vector<std::string_view> names;
  int steps = 0;  // 0: as many as the case says
};

bool parse(int argc, char** argv, Arguments& out) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--steps" && i + 1 < argc) {
      const char* end = argv[i + 1] + std::strlen(argv[i + 1]);
      const auto result = std::from_chars(argv[++i], end, out.steps);
      if (result.ec != std::errc() || result.ptr != end || out.steps <= 0) return false;
    } else if (argument.starts_with("-")) {
      return false;
    } else {
      out.names.push_back(argument);
    }
  }
  return true;
}

void run(const bench::Case& scene, int steps) {
  std::vector<bench::EngineKind> contestants = {bench::pfxEngine(scene, 1)};
  for (const bench::EngineKind& peer : bench::peers()) contestants.push_back(peer);

  std::printf("%s, %d steps: %s\n", std::string(scene.name).c_str(), steps, std::string(scene.shows).c_str());
  std::printf("  %-16s %24s %22s %9s %12s %10s\n", "engine", "ms a step [quartiles]", "ratio [quartiles]",
              "worst ms", "kinetic J", "drift m");
  for (const bench::Result& r : bench::race(scene, contestants, steps)) {
    if (!r.supported) {
      std::printf("  %-16s cannot run this scene\n", r.engine.c_str());
      continue;
    }
    std::printf("  %-16s %8.3f [%5.3f, %6.3f] %7.2f [%4.2f, %5.2f] %9.3f %12.4g %10.4f\n", r.engine.c_str(),
                r.ms_per_step.median, r.ms_per_step.lower, r.ms_per_step.upper, r.ratio.median, r.ratio.lower,
                r.ratio.upper, r.worst_ms, r.kinetic_energy, r.largest_drift);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fputs("usage: peers [CASE...] [--steps N]\n", stderr);
    return 2;
  }
  int found = 0;
  for (const bench::Case& scene : bench::cases()) {
    const auto& names = arguments.names;
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
    ++found;
    run(scene, arguments.steps > 0 ? arguments.steps : scene.steps);
  }
  if (found == 0) std::fputs("peers: no such case\n", stderr);
  return found > 0 ? 0 : 2;
}
