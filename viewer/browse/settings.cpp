#include "viewer/browse/settings.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {

namespace {

using Json = nlohmann::json;

template <class T>
void take(const Json& from, const char* name, T& value) {
  const auto found = from.find(name);
  if (found == from.end()) return;
  try {
    value = found->get<T>();
  } catch (const Json::exception&) {
    // Of another type: the default stays.
  }
}

}  // namespace

std::filesystem::path settingsFile() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder)
    return std::filesystem::path(folder) / "vitrine" / "browse.json";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".config" / "vitrine" / "browse.json";
  return {};
}

BrowseSettings readSettings(const std::filesystem::path& file) {
  BrowseSettings s;
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return s;
  Json json;
  try {
    json = Json::parse(readText(file), nullptr, false);
  } catch (const InputError&) {
    return s;
  }
  if (!json.is_object()) return s;
  take(json, "width", s.width);
  take(json, "height", s.height);
  take(json, "target", s.target);
  take(json, "speed", s.speed);
  take(json, "show_ui", s.show_ui);
  take(json, "show_costs", s.show_costs);
  s.width = std::clamp(s.width, 320, 7680);
  s.height = std::clamp(s.height, 240, 4320);
  s.speed = s.speed >= 0.05f && s.speed <= 4.0f ? s.speed : 1.0f;
  std::string overlays = "none";
  take(json, "overlays", overlays);
  try {
    s.overlays = parseOverlays(overlays);
  } catch (const InputError&) {
    s.overlays = {};
  }
  return s;
}

void writeSettings(const std::filesystem::path& file, const BrowseSettings& s) {
  if (file.empty()) return;
  const Json json = {{"width", s.width},
                     {"height", s.height},
                     {"target", s.target},
                     {"speed", s.speed},
                     {"show_ui", s.show_ui},
                     {"show_costs", s.show_costs},
                     {"overlays", overlayList(s.overlays)}};
  try {
    writeText(file, json.dump(2) + "\n");
  } catch (const InputError&) {
    // Nothing is remembered.
  }
}

}  // namespace viewer
