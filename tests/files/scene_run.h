// Runs sample scenes in worlds that came from files, next to the world that the scene built.
#pragma once

#include <memory>

#include <cctype>
#include <string>

#include "samples/scene.h"

namespace samples {

// A scene with its script, and the world that it built.
struct RunningScene {
  explicit RunningScene(const SceneEntry& entry) : world(entry.world), scene(entry.make()) { scene->build(world); }

  void step() { stepIn(world); }
  // The script acts on another world with the same bodies.
  void stepIn(pfx::World& other) {
    scene->beforeStep(other, kTimeStep);
    other.step(kTimeStep);
    scene->afterStep(other, kTimeStep);
  }

  pfx::World world;
  std::unique_ptr<Scene> scene;
};

// Names of scenes as test names.
inline std::string testName(const SceneEntry& entry) {
  std::string name = std::string(entry.sample) + "_" + std::string(entry.name);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace samples
