// vitrine list: samples, scenes, and the stages that each one runs.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

std::vector<std::string> stagesOf(const SceneSpec& spec) {
  SceneRun run(spec);
  run.step();  // a world decides in its first step what it has to do
  std::vector<std::string> names;
  for (std::string_view stage : run.world().stages()) names.emplace_back(stage);
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
    for (const std::string& stage : stagesOf(s)) std::printf("%s%s", separator, stage.c_str()), separator = ", ";
    std::printf("\n");
  }
  return 0;
}

}  // namespace

void addListCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("list", "Samples, scenes, and the stages that each one runs");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([&action, json] {
    action = [json] { return *json ? listJson(allScenes()) : listText(allScenes()); };
  });
}

}  // namespace viewer
