// vitrine browse: the interactive browser.
#include "viewer/browse/browse.h"
#include "viewer/commands/commands.h"

namespace viewer {

void addBrowseCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("browse", "The interactive browser; also what runs without a command");
  const auto options = std::make_shared<BrowseOptions>();
  command->add_option("TARGET", options->target, "SAMPLE[/SCENE] to begin with");
  command->add_option("--frames", options->frames, "Close after so many pictures");
  command->add_option("--pictures", options->pictures, "Folder for screenshots");
  command->add_option("--shaders", options->shader_dir, "Read the shaders from this folder");
  action = [] { return browse({}); };
  command->callback([&action, options] { action = [options] { return browse(*options); }; });
}

}  // namespace viewer
