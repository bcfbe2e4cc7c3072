// The program: picks the subcommand and turns every failure into one line and an exit status.
#include <cstdio>
#include <string>

#include "viewer/commands/commands.h"

namespace viewer {
namespace {

constexpr int kBadUsage = 2;

// The first line of a message: libraries may add more.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string nameOf(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "vitrine" : "vitrine " + chosen.front()->get_name();
}

int fail(const std::string& who, const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s: %s\n", who.c_str(), message.c_str());
  return kBadUsage;
}

// CLI11 names what it did not understand; we add where help is.
int failUsage(const CLI::App& app, int argc, const char* const* argv, const CLI::ParseError& error) {
  const std::string who = nameOf(app);
  const bool unknown = app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
  const std::string cause =
      unknown ? "unknown command \"" + std::string(argv[1]) + "\"" : firstLine(error.what());
  return fail(who, cause + "; see " + who + " --help");
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
  CLI::App app("Vitrine: rigid-body physics you can see into. Without a command: the interactive browser.",
               "vitrine");
  app.require_subcommand(0, 1);
  app.footer("Exit status: 0 success, 1 a comparison or check failed, 2 bad usage or bad input.");
  Action action;
  addBrowseCommand(app, action);
  addListCommand(app, action);
  addRenderCommand(app, action);
  addVerifyCommand(app, action);
  addCompareCommand(app, action);
  addInspectCommand(app, action);
  addMeasureCommand(app, action);
  addRecordCommand(app, action);
  addReplayCommand(app, action);
  addBenchCommand(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return failUsage(app, argc, argv, error);
  }
  try {
    return action();
  } catch (const std::exception& error) {
    return fail(nameOf(app), firstLine(error.what()));
  }
}

}  // namespace viewer
