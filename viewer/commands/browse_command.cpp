// vitrine browse: the interactive browser.
#include <cstdlib>

#include "viewer/commands/commands.h"
#include "viewer/input_error.h"
#include "viewer/run/scene_spec.h"

namespace viewer {
namespace {

int browse(const std::string& target) {
  const std::vector<SceneSpec> all = allScenes();
  if (!target.empty()) findTarget(all, target);
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
    throw InputError("there is no display to open a window on; draw without one: vitrine render " +
                     (target.empty() ? all.front().sample : target) + " --out pictures");
  throw InputError("this build has no browser yet");
}

}  // namespace

void addBrowseCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("browse", "The interactive browser; also what runs without a command");
  const auto target = std::make_shared<std::string>();
  command->add_option("TARGET", *target, "SAMPLE[/SCENE] to begin with");
  action = [] { return browse(""); };
  command->callback([&action, target] { action = [target] { return browse(*target); }; });
}

}  // namespace viewer
