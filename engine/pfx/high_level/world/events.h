// What happened to the bodies of a world in a step, and what an application may say about contacts before they are solved.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/high_level/world/joint_def.h"

namespace pfx {

// Two bodies began or ceased to touch; body_a has the lower index. Bodies touch from when they are nearer than half a
// percent of the smaller one's smallest half extent (at least 0.1 mm) until they are twice as far.
struct TouchEvent {
  BodyId body_a, body_b;
};

// A contact that began with bodies that approached faster than WorldDef::hit_speed.
struct HitEvent {
  BodyId body_a, body_b;
  Vec3 point = Vec3::Zero();   // m, world
  Vec3 normal = Vec3::Zero();  // unit, from A to B
  float speed = 0.0f;          // m/s, along the normal
};

struct TriggerEvent {
  BodyId trigger, body;
};

// All events since the end of the step before, each list in ascending order of bodies. The spans hold until the next
// step. A body that has been removed since ceases to touch; its id is not valid any more.
struct WorldEvents {
  std::span<const TouchEvent> touch_begin, touch_end;
  std::span<const HitEvent> hits;  // each also in touch_begin
  std::span<const TriggerEvent> trigger_enter, trigger_leave;
  std::span<const BodyId> fell_asleep, woke;
  std::span<const JointId> broken_joints;
};

// One manifold that the solver is about to get. What is changed counts for this step only.
struct ContactModification {
  BodyId body_a, body_b;
  ContactManifold manifold;                                  // points may be moved or removed, the normal turned
  std::array<uint32_t, kMaxContactPoints> user_data = {};    // of the triangle of each point; 0 where there is none
  float friction = 0.0f;
  float restitution = 0.0f;
  float rolling_resistance = 0.0f;    // m
  float torsional_resistance = 0.0f;  // m
};

// Called in the order of pairs, on the thread that steps. False: the bodies pass through each other here.
using ContactModifier = std::function<bool(ContactModification&)>;

// Whether two bodies whose bounds meet may touch at all; asked in every step, in the order of pairs.
using PairFilter = std::function<bool(BodyId body_a, BodyId body_b)>;

}  // namespace pfx
