// vitrine list: samples, scenes, and the stages that each one runs.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

// A world reports the stages of its last step, so that a scene has to run a little to show all: one second,
// in which what falls has landed; scenes of thousands of bodies, where everything touches from the start, run for less.
// Stages that appear later are put behind the one that runs before them.
std::vector<std::string> stagesOf(const SceneSpec& spec) {
  constexpr uint32_t kBodySteps = 6000;
  SceneRun run(spec);
  std::vector<std::string> names;
  const uint32_t steps = std::clamp(kBodySteps / (run.world().counts().bodies + 1), 2u, 60u);
  for (uint32_t i = 0; i < steps; ++i) {
    run.step();
    auto place = names.begin();
    for (std::string_view stage : run.world().stages()) {
      auto known = std::find(names.begin(), names.end(), stage);
      if (known == names.end()) known = names.insert(place, std::string(stage));
      place = known + 1;
    }
  }
  return names;
}

int listJson(std::span<const SceneSpec> scenes) {
  auto samples = nlohmann::ordered_json::array();
  for (const SceneSpec& s : scenes) {
    if (samples.empty() || samples.back()["sample"] != s.sample)
      samples.push_back({{"sample", s.sample}, {"scenes", nlohmann::ordered_json::array()}});
    samples.back()["scenes"].push_back(
        {{"name", s.name}, {"shows", s.shows}, {"stages", stagesOf(s)}, {"frames", s.frames}});
  }
  std::puts(samples.dump(2).c_str());
  return 0;
}

int listText(std::span<const SceneSpec> scenes) {
  std::string_view sample;
  for (const SceneSpec& s : scenes) {
    if (s.sample != sample) std::printf("%s\n", s.sample.c_str());
    sample = s.sample;
    std::printf("  %-24s %s\n  %-24s stages:", s.name.c_str(), s.shows.c_str(), "");
    const char* separator = " ";
    for (const std::string& stage : stagesOf(s))
      std::printf("%s%s", separator, stage.c_str()), separator = ", ";
    std::printf("\n");
  }
  return 0;
}

}  // namespace

void addListCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("list", "Samples, scenes, and the stages that each one runs");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback(
      [&action, json] { action = [json] { return *json ? listJson(allScenes()) : listText(allScenes()); }; });
}

}  // namespace viewer
