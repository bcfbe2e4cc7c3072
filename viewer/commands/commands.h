// The subcommands of the program: each adds its options to the command line and sets what to do when it is
// chosen.
//
// Exit status: 0 success, 1 a comparison or check failed, 2 bad usage or bad input (an exception, told in one
// line).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace viewer {

using Action = std::function<int()>;  // returns the exit status

void addBrowseCommand(CLI::App& app, Action& action);
void addListCommand(CLI::App& app, Action& action);
void addRenderCommand(CLI::App& app, Action& action);
void addVerifyCommand(CLI::App& app, Action& action);
void addCompareCommand(CLI::App& app, Action& action);
void addInspectCommand(CLI::App& app, Action& action);
void addMeasureCommand(CLI::App& app, Action& action);
void addRecordCommand(CLI::App& app, Action& action);
void addReplayCommand(CLI::App& app, Action& action);
void addBenchCommand(CLI::App& app, Action& action);

// Reads the command line, does what it says, and returns the exit status.
int runProgram(int argc, const char* const* argv);

}  // namespace viewer
