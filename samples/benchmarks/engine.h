// An engine that can run a benchmark scene: ours, and those of others that are installed.
//
// Every scene is described once, as a pfx::World. Another engine builds its own bodies from that world's
// public data, so that each of our scenes can be run by all and no second description can drift away from the
// first.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace samples::benchmarks {

struct BodyMotion {
  pfx::Transform pose;         // of the centre of mass
  pfx::Vec3 linear_velocity;   // m/s
  pfx::Vec3 angular_velocity;  // rad/s, world axes
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void step(float dt) = 0;                     // s
  virtual BodyMotion motion(uint32_t body) const = 0;  // by the index that the body has in the pfx::World
};

struct EngineKind {
  std::string_view name;  // "pfx", "Bullet 3.24 (float)"
  // A world of the engine in the state of the given one. Null when the scene holds something that the engine,
  // or the translation, does not know.
  std::function<std::unique_ptr<Engine>(const pfx::World&)> make;
};

// The other engines that this program was built with, in a fixed order.
std::vector<EngineKind> peers();

}  // namespace samples::benchmarks
