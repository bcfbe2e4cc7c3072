// Runs the real program, as a script would, and keeps what it said.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "viewer/file.h"

namespace golden_tests {

struct Outcome {
  int status = -1;
  std::string out, err;
  long errorLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

// A folder of its own for a test, removed at the end.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("vitrine_" + name + "_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

// A shell command line, without a display.
inline Outcome runShell(const std::string& command) {
  const ScratchFolder scratch("shell");
  const std::string full = "unset DISPLAY WAYLAND_DISPLAY; " + command + " >'" + (scratch / "out") + "' 2>'" +
                           (scratch / "err") + "' </dev/null";
  const int status = std::system(full.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), viewer::readText(scratch / "out"),
          viewer::readText(scratch / "err")};
}

inline Outcome runVitrine(const std::string& arguments) {
  return runShell(std::string("'") + VITRINE_PROGRAM + "' " + arguments);
}

}  // namespace golden_tests
