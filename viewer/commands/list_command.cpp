// vitrine list: samples, scenes, and the stages that each one runs.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "pfx/high_level/pipeline/possible_stages.h"
#include "viewer/commands/commands.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

// The stages that the scene can enter: it is built and its script prepares the first step, which is not made.
std::vector<std::string_view> stagesOf(const SceneSpec& spec) {
  SceneRun run(spec);
  run.scene().beforeStep(run.world(), run.settings().dt);
  return pfx::possibleStages(run.world());
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
    for (std::string_view stage : stagesOf(s)) {
      std::printf("%s%.*s", separator, static_cast<int>(stage.size()), stage.data());
      separator = ", ";
    }
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
