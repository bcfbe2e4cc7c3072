// What a person does to a running scene. A run that is started again with the same inputs gives the same bits.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "viewer/run/scene_run.h"

namespace viewer {

// Pulls a body for one step by a point of it: a damped spring towards `target`, no stronger than a few times the
// weight of the body.
struct Pull {
  uint32_t body = 0;
  pfx::Vec3 local = pfx::Vec3::Zero();   // m, the point that is held, in the frame of the body
  pfx::Vec3 target = pfx::Vec3::Zero();  // m, where it is wanted
};
struct ThrowBall {
  pfx::Vec3 from = pfx::Vec3::Zero();      // m
  pfx::Vec3 velocity = pfx::Vec3::Zero();  // m/s
  float radius = 0.1f;                     // m
};
struct SetParameter {
  uint32_t index = 0;  // in Scene::parameters()
  float value = 0.0f;
};
struct SetTimeStep {
  float dt = samples::kTimeStep;  // s
};
using SceneInput =
    std::variant<Pull, ThrowBall, SetParameter, SetTimeStep, samples::Controls, pfx::SolverSettings>;

// Given when so many steps were made, before the next one.
struct TimedInput {
  uint64_t step = 0;
  SceneInput what;
};

// Inputs that name something that does not exist do nothing.
void applyInput(SceneRun& run, const SceneInput& input);

// Makes steps until so many were made, each after its inputs (ascending by step; those of the last step are not given).
void stepTo(SceneRun& run, uint64_t steps, std::span<const TimedInput> inputs);

}  // namespace viewer
