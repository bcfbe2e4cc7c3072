// A world for probes, and what is asked of it again and again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "samples/hard_cases/witness.h"
#include "samples/shared/builders.h"

namespace samples::benchmarks {

template <class... Values>
std::string described(const char* pattern, Values... values) {
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

struct Material {
  float friction = 0.6f, restitution = 0.0f, rolling_resistance = 0.0f;
};

class ProbeWorld {
 public:
  explicit ProbeWorld(int substeps, const pfx::Vec3& gravity = {0, -10, 0})
      : world({.gravity = gravity, .substeps = substeps, .sleeping = true, .sleep_velocity = 0.05f, .sleep_steps = 30}) {}

  pfx::BodyId add(const pfx::Geometry& geometry, const pfx::Vec3& at, float mass, const Material& m = {}) {
    return world.addBody({.pose = {.position = at},
                          .shapes = {shape(geometry)},
                          .mass = mass,
                          .restitution = m.restitution,
                          .friction = m.friction,
                          .rolling_resistance = m.rolling_resistance});
  }
  pfx::BodyId addFixed(const pfx::Geometry& geometry, const pfx::Vec3& at, const Material& m = {}) {
    return world.addBody({.pose = {.position = at},
                          .motion_type = pfx::MotionType::Fixed,
                          .shapes = {shape(geometry)},
                          .restitution = m.restitution,
                          .friction = m.friction});
  }
  void addFloor(const Material& m = {}) { addFixed(pfx::Box{pfx::Vec3(100, 2, 100)}, pfx::Vec3(0, -2, 0), m); }

  const pfx::RigidState& state(pfx::BodyId id) const { return world.states()[id.index]; }

  // Until everything sleeps or `steps` are over; returns the step at which the last body fell asleep, or -1.
  int rest(int steps) {
    witness.begin(world);
    for (int i = 0; i < steps; ++i) {
      world.step(kTimeStep);
      if (world.counts().awake == 0) return i + 1;
    }
    return -1;
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.step(kTimeStep);
  }

  // "asleep at step 66, drift 14 mm, drop 34 mm"
  std::string restText(int steps) {
    const int asleep = rest(steps);
    double drift = 0.0, drop = 0.0;
    for (uint32_t i = 0; i < witness.start.size(); ++i) {
      if (!pfx::isDynamic(world.states()[i].motion_type)) continue;
      const pfx::Vec3 moved = world.states()[i].position - witness.start[i];
      drift = std::max(drift, std::sqrt(double(moved.x() * moved.x() + moved.z() * moved.z())));
      drop = std::max(drop, -double(moved.y()));
    }
    const std::string when = asleep < 0 ? described("awake after %d steps", steps) : described("asleep at step %d", asleep);
    return when + described(", drift %.3g mm, drop %.3g mm", 1e3 * drift, 1e3 * drop);
  }

  double penetration() const {
    hard_cases::Witness now;
    now.look(world);
    return now.penetration;
  }

  pfx::World world;
  hard_cases::Witness witness;
};

}  // namespace samples::benchmarks
