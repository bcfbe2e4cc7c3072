// What the hard cases are judged by, followed from the first step on: how deep bodies overlap, how far they have gone,
// how fast they are, and how far joints are apart.
#pragma once

#include <algorithm>
#include <vector>

#include "samples/scene.h"

namespace samples::hard_cases {

struct Witness {
  std::vector<pfx::Vec3> start;  // m, by body
  double penetration = 0.0;      // m, deepest so far
  double gap = 0.0;              // m, widest of a joint so far
  double fastest = 0.0;          // m/s, so far

  void begin(const pfx::World& world) {
    for (const pfx::RigidState& s : world.states()) start.push_back(s.position);
  }
  void look(const pfx::World& world) {
    for (const pfx::Pair& pair : world.contactPairs())
      for (const pfx::ContactManifold& m : world.manifolds(pair))
        for (int i = 0; i < m.num_points; ++i) penetration = std::max(penetration, -double(m.points[size_t(i)].distance));
    for (uint32_t i = 0; i < world.jointLinks().size(); ++i)
      if (world.jointLinks()[i].exists) gap = std::max(gap, world.jointError(i).distance);
    fastest = std::max(fastest, speed(world));
  }

  double drift(const pfx::World& world, uint32_t body) const {
    return double((world.states()[body].position - start[body]).norm());
  }
  // Of all bodies that are simulated.
  double largestDrift(const pfx::World& world) const {
    double worst = 0.0;
    for (uint32_t i = 0; i < start.size(); ++i)
      if (pfx::isDynamic(world.states()[i].motion_type)) worst = std::max(worst, drift(world, i));
    return worst;
  }
  static double speed(const pfx::World& world) {
    double worst = 0.0;
    for (const pfx::RigidState& s : world.states())
      if (pfx::isDynamic(s.motion_type)) worst = std::max(worst, double(s.linear_velocity.norm()));
    return worst;
  }
};

// A scene with a witness; it builds its bodies in fill().
class WitnessedScene : public Scene {
 public:
  void build(pfx::World& world) final {
    fill(world);
    witness_.begin(world);
  }
  void afterStep(pfx::World& world, float) override { witness_.look(world); }

 protected:
  virtual void fill(pfx::World& world) = 0;
  const Witness& witness() const { return witness_; }

 private:
  Witness witness_;
};

// The scenes, in the order of the table.
std::vector<SceneEntry> stackScenes();
std::vector<SceneEntry> structureScenes();
std::vector<SceneEntry> machineScenes();

}  // namespace samples::hard_cases
