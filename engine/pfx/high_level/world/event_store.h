// Events of a world while they are gathered. Nothing here is touched in worlds that do not report events.
#pragma once

#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/high_level/world/events.h"

namespace pfx {

// Two bodies that touch, or a body in a trigger.
struct TouchingPair {
  BodyId body_a, body_b;  // ascending
  bool is_trigger = false;
  uint64_t key() const { return Pair{.body_a = body_a.index, .body_b = body_b.index}.key(); }
};

// Bodies that do not touch yet, before the solver changed how fast they come together.
struct Approach {
  uint64_t key = 0;
  float gap = 0.0f;    // m
  float speed = 0.0f;  // m/s
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
};

struct EventStore {
  Vector<TouchingPair> touching, next_touching;  // by key
  Vector<Approach> approaches;                   // by key
  Vector<TouchEvent> begin, end;
  Vector<HitEvent> hits;
  Vector<TriggerEvent> enter, leave;
  Vector<BodyId> fell_asleep, woke;
  Vector<BodyId> next_fell_asleep, next_woke;  // since the last report
};

}  // namespace pfx
