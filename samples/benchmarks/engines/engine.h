// An engine that can run a benchmark scene: ours, and those of others that are installed.
//
// Every scene is described once, as a pfx::World. Another engine builds its own bodies and joints from that world's
// public data, so that each of our scenes can be run by all and no second description can drift away from the
// first.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "samples/scene.h"
#include "samples/shared/body_motion.h"

namespace samples::benchmarks {

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void step(float dt) = 0;                     // s
  virtual BodyMotion motion(uint32_t body) const = 0;  // by the index that the body has in the pfx::World
};

struct EngineKind {
  std::string name;  // "pfx", "Bullet, float"
  // A world of the engine in the state of the given one. Null when the scene holds something that the engine,
  // or the translation, does not know.
  std::function<std::unique_ptr<Engine>(const pfx::World&)> make;
  bool threaded = false;  // works with more threads than the caller's
};

// The other engines that this program was built with, with their usual settings, in a fixed order.
std::vector<EngineKind> peers();

// The same, and those of their solvers that are slower and more accurate.
std::vector<EngineKind> peersWithAllSolvers();

// Ours, with the scene and its script.
std::unique_ptr<Engine> makePfxEngine(const pfx::WorldDef& def, std::unique_ptr<Scene> scene);

}  // namespace samples::benchmarks
