// The interactive browser.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace viewer {

struct BrowseOptions {
  std::string target;   // SAMPLE[/SCENE] to begin with; empty: the one of the last time
  uint64_t frames = 0;  // closes by itself after so many pictures; 0: stays
  std::filesystem::path pictures = "pictures";  // folder for screenshots
  std::string shader_dir;                       // shaders from a folder instead of the built-in ones
};

// Opens a window and stays until it is closed; returns the exit code of the program. Throws InputError when
// there is no display, naming the way to draw without one, and for an unknown target.
int browse(const BrowseOptions& options);

}  // namespace viewer
