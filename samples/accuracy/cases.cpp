// The table of all accuracy cases.
#include <algorithm>

#include "samples/accuracy/case.h"

namespace samples::accuracy {

pfx::WorldDef worldDef(const Case& accuracy_case) { return {.gravity = accuracy_case.gravity}; }

std::span<const Case> cases() {
  static const std::vector<Case> table = [] {
    std::vector<Case> all;
    for (const auto family : {freeMotionCases, jointCases, frictionCases, restCases})
      for (const Case& c : family()) all.push_back(c);
    return all;
  }();
  return table;
}

const Case* findCase(std::string_view name) {
  const auto found = std::ranges::find(cases(), name, &Case::name);
  return found == cases().end() ? nullptr : &*found;
}

}  // namespace samples::accuracy
