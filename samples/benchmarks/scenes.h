// The benchmark scenes: large enough that one stage or another decides the time of a step.
#pragma once

#include <span>
#include <string_view>

#include "pfx/high_level/world/world.h"

namespace samples::benchmarks {

struct Case {
  std::string_view name;
  std::string_view shows;      // what the scene stresses
  void (*build)(pfx::World&);  // fills an empty world
  int steps;                   // of 1/60 s
  bool starts_at_rest;         // so that any motion of a body is an error
};

std::span<const Case> cases();

void buildPyramid(pfx::World& world, int rows);
void buildPile(pfx::World& world, int bodies_a_side);
void buildTerrain(pfx::World& world);

}  // namespace samples::benchmarks
