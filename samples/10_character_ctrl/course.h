// The course: what stands there, and the way that its first character takes through it.
#pragma once

#include <span>

#include "pfx/high_level/world/world.h"

namespace samples {

// One leg of a way. It ends at its goal, when its platform is there, or after `seconds`.
struct Leg {
  enum class Until { There, PlatformNear, PlatformFar, Time };
  pfx::Vec3 to;
  float speed = 1.0f;  // share of the walking or running speed
  Until until = Until::There;
  float seconds = 8.0f;
  bool run = false, crouch = false, jump = false;
};

std::span<const Leg> heroWay();
std::span<const Leg> walkerWay();

struct Course {
  pfx::BodyId platform, bar, turntable;

  // The poses of the scripted bodies t seconds after the start.
  pfx::Transform platformPose(float t) const;
  pfx::Transform barPose(float t) const;
  pfx::Transform turntablePose(float t) const;
};

// Adds ground, stairs, decks, the moving bodies, a chute of 60 degrees, hurdle, tunnel, boxes.
Course addCourse(pfx::World& world);

inline const pfx::Vec3 kHeroStart(-7.6f, 0.0f, 4.0f), kWalkerStart(3.4f, 0.0f, 1.45f),
    kShovedStart(-6.2f, 0.0f, -1.6f);
inline const pfx::Vec3 kTurntableAt(6.6f, 0.1f, 0.2f);

}  // namespace samples
