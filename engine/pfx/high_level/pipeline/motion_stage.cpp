// Bodies whose pose is given from outside.
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx::stage {

// A body that was told its pose takes it exactly. It stands still afterwards until it is told the next one; a
// body that was only given a velocity goes on with that.
void followKeyframes(World::Impl& w) {
  for (uint32_t i : w.moving) {
    RigidState& s = w.store.states[i];
    if (isDynamic(s.motion_type)) continue;
    s.position += w.dt * s.linear_velocity;
    s.orientation = (expMap(w.dt * s.angular_velocity) * s.orientation).normalized();
  }
  for (const BodyPose& k : w.keyframes) {
    RigidState& s = w.store.states[k.body];
    s.position = k.pose.position;
    s.orientation = k.pose.orientation.normalized();
    s.linear_velocity = s.angular_velocity = Vec3::Zero();
  }
  w.keyframes.clear();
  w.active_changed = true;  // those that stand still now are no longer listed as moving
}

}  // namespace pfx::stage
