// The benchmark scenes: large enough that one stage or another decides the time of a step.
//
// The same scenes are raced against other engines (engines/race.h) and shown as a sample. The large ones have the
// figures of scenes that other engines are measured by: pyramids, a net of joints, a drum, a rain of ragdolls.
#pragma once

#include <span>
#include <string_view>

#include "samples/scene.h"

namespace samples::benchmarks {

struct Case {
  std::string_view name;
  std::string_view shows;  // what the scene stresses
  std::unique_ptr<Scene> (*make)();
  int steps;            // of 1/60 s
  bool starts_at_rest;  // so that any motion of a body is an error
  bool large = false;   // thousands of bodies: other engines take part when they are asked for
  pfx::WorldDef world = {};
  CameraPose camera = {};
  std::vector<int> frames = {};  // golden frames
};

std::span<const Case> cases();

// Null when there is none of this name.
const Case* findCase(std::string_view name);

// Families of cases, in the order of the table.
std::vector<Case> smallCases();
std::vector<Case> largeCases();
Case rainCase();

}  // namespace samples::benchmarks
