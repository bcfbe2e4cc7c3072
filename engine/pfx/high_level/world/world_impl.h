// What a world holds: the bodies, and the buffers that the stages hand to each other.
#pragma once

#include "pfx/high_level/pipeline/stage.h"
#include "pfx/high_level/world/body_store.h"
#include "pfx/high_level/world/world.h"
#include "pfx/low_level/broadphase/decompose.h"
#include "pfx/low_level/broadphase/sweep.h"
#include "pfx/low_level/collision/contact_store.h"
#include "pfx/low_level/collision/detect.h"
#include "pfx/low_level/island/islands.h"
#include "pfx/low_level/solver/soft_step.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct KeyframeTarget {
  uint32_t body;
  Transform pose;  // at the end of the step
};

struct World::Impl {
  explicit Impl(const WorldDef& d) : def(d), tasks(d.workers) {}

  WorldDef def;
  TaskManager tasks;
  BodyStore store;
  float dt = 0.0f;  // s, of the step under way
  uint64_t step_count = 0;

  std::vector<uint32_t> active;  // awake dynamic bodies, ascending
  bool active_changed = true;    // a body was added, removed, or changed its type

  std::vector<KeyframeTarget> keyframes;

  // Broad phase
  std::vector<BroadphaseProxy> proxies;
  std::vector<ContactReach> reach;  // by body
  SweepBroadphase sweep;
  std::vector<Pair> pairs, next_pairs;  // sorted by key
  PairChanges changes;

  // Collision
  ContactStore contacts;
  CollisionDetector detector;

  // Islands, of awake bodies and of the pairs that touch
  Islands islands;
  std::vector<Link> island_links;
  std::vector<uint32_t> island_link_pairs;  // index into pairs, by link

  // Solver
  std::vector<ContactConstraint> constraints;
  std::vector<uint32_t> solver_index;  // by body; kNoSolverBody when it has none
  std::vector<uint32_t> solved;        // body of each solver body
  std::vector<uint32_t> free_bodies;   // active bodies without a constraint
  std::vector<SolverBody> solver_bodies;
  std::vector<BodyMotion> motions;
  std::vector<uint8_t> solver_dynamic;
  SoftStep soft_step;

  std::vector<StageTime> times;

  bool solves(const Pair& pair) const;
  void refreshActive();
  void linkIslands();
};

inline constexpr uint32_t kNoSolverBody = 0xffffffffu;

}  // namespace pfx
