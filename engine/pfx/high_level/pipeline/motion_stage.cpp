// Bodies that the solver does not move: key frames; and bodies that stop moving: sleep.
#include <algorithm>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {

void followKeyframes(World::Impl& w) {
  for (const KeyframeTarget& k : w.keyframes) {
    RigidState& s = w.store.states[k.body];
    s.position = k.pose.position;
    s.orientation = k.pose.orientation.normalized();
    s.linear_velocity = s.angular_velocity = Vec3::Zero();
  }
  w.keyframes.clear();
}

void putToSleep(World::Impl& w) {
  w.linkIslands();
  const float limit2 = w.def.sleep_velocity * w.def.sleep_velocity;
  for (uint32_t k = 0; k < w.islands.size(); ++k) {
    uint32_t least = 0xffffffffu;
    for (uint32_t i : w.islands.bodies(k)) {
      RigidState& s = w.store.states[i];
      const bool slow = s.linear_velocity.squaredNorm() < limit2 && s.angular_velocity.squaredNorm() < limit2;
      s.sleep_count = slow && s.can_sleep ? s.sleep_count + 1 : 0;
      least = std::min(least, s.sleep_count);
    }
    if (least <= w.def.sleep_steps) continue;
    for (uint32_t i : w.islands.bodies(k)) {
      w.store.states[i].asleep = true;
      w.store.states[i].linear_velocity = w.store.states[i].angular_velocity = Vec3::Zero();
    }
    w.active_changed = true;
  }
}

}  // namespace pfx::stage
