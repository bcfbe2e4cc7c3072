// The table of overlay names.
#include "viewer/run/overlays.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "viewer/input_error.h"

namespace viewer {
namespace {

struct Entry {
  std::string_view name;
  bool Overlays::*flag;
};

constexpr std::array kTable = {
    Entry{"aabb", &Overlays::aabb},         Entry{"axes", &Overlays::axes},
    Entry{"contacts", &Overlays::contacts}, Entry{"islands", &Overlays::islands},
    Entry{"joints", &Overlays::joints},     Entry{"velocity", &Overlays::velocity},
    Entry{"world", &Overlays::world},
};

}  // namespace

std::string overlayNames() {
  std::string names;
  for (const Entry& e : kTable) names += (names.empty() ? "" : ", ") + std::string(e.name);
  return names;
}

std::string overlayList(const Overlays& overlays) {
  std::string names;
  for (const Entry& e : kTable)
    if (overlays.*e.flag) {
      if (!names.empty()) names += ',';
      names += e.name;
    }
  return names.empty() ? "none" : names;
}

Overlays parseOverlays(const std::string& list) {
  Overlays out;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    if (part.empty() || part == "none") continue;
    bool known = part == "all";
    for (const Entry& e : kTable)
      if (part == "all" || part == e.name) out.*e.flag = true, known = true;
    if (!known)
      throw InputError("--overlay \"" + list + "\": \"" + part + "\" is not known; known: " + overlayNames());
  }
  return out;
}

}  // namespace viewer
