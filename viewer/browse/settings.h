// What the browser remembers from one start to the next.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/run/overlays.h"

namespace viewer {

struct BrowseSettings {
  int width = 1280, height = 800;  // of the window, screen units
  std::string target;              // the scene that was shown last
  float speed = 1.0f;
  bool show_ui = true, show_costs = false;
  Overlays overlays;

  bool operator==(const BrowseSettings&) const = default;
};

// vitrine/browse.json in the user's folder for settings (XDG_CONFIG_HOME or ~/.config); empty when there is
// none.
std::filesystem::path settingsFile();

// Defaults for whatever is missing, damaged or out of range: old settings never keep the browser from
// starting.
BrowseSettings readSettings(const std::filesystem::path& file);
// A folder that cannot be written to is no reason to fail: then nothing is remembered.
void writeSettings(const std::filesystem::path& file, const BrowseSettings& settings);

}  // namespace viewer
