// What a world holds: the bodies, and the buffers that the stages hand to each other.
#pragma once

#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "pfx/high_level/pipeline/stage.h"
#include "pfx/high_level/world/apart_pairs.h"
#include "pfx/high_level/world/body_store.h"
#include "pfx/high_level/world/event_store.h"
#include "pfx/high_level/world/joint_store.h"
#include "pfx/high_level/world/mesh_motion.h"
#include "pfx/high_level/world/particle_store.h"
#include "pfx/high_level/world/world.h"
#include "pfx/low_level/broadphase/decompose.h"
#include "pfx/low_level/broadphase/sweep.h"
#include "pfx/low_level/broadphase/tree_broadphase.h"
#include "pfx/low_level/collision/contact_store.h"
#include "pfx/low_level/collision/detect.h"
#include "pfx/low_level/continuous/time_of_impact.h"
#include "pfx/low_level/island/islands.h"
#include "pfx/low_level/solver/joint_components.h"
#include "pfx/low_level/solver/newton_island.h"
#include "pfx/low_level/solver/soft_step.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

struct BodyPose {
  uint32_t body;
  Transform pose;  // at the end of the step
};

// An island that the island solver takes.
struct NewtonTask {
  NewtonIsland solver;
  Vector<uint32_t> bodies;  // indices of states, ascending, movable or not
  Vector<BodyMotion> motions;
  Vector<ContactConstraint> constraints;
  Vector<JointConstraint> joints;
  Vector<JointComponent*> components;  // of the joints
  bool is_solved = false;
};

// Where a fast body is held up in a step.
struct Stop {
  float fraction = 1.0f;      // of the step; 1: it is not
  Vec3 point = Vec3::Zero();  // m, world, of the impact
  uint32_t by = 0;            // the body that it hits
};

// A pair of which one body moves far in a step, and where the two first touch.
struct FastPair {
  uint32_t pair;  // index into pairs
  Impact impact;
};

constexpr uint8_t kLongSinceTouch = 255;

// A manifold that the application changed, which the solver gets in place of the original.
struct ModifiedContact {
  ContactManifold manifold;
  ContactManifold* original;
};

struct World::Impl {
  // In the memory that its thread names (block_memory.h).
  explicit Impl(const WorldDef& d) : def(d), tasks(d.workers) {}

  BlockMemory* memory = currentMemory();
  WorldDef def;
  TaskManager tasks;
  BodyStore store;
  Deque<ConvexMesh> convex_meshes;  // kept for shapes that point at them
  Deque<LargeMesh> large_meshes;
  float dt = 0.0f;  // s, of the step under way
  float substep = 0.0f;  // s, in which the remembered impulses of contacts acted; 0: there are none
  uint64_t step_count = 0;

  Vector<uint32_t> active;  // awake dynamic bodies, ascending
  Vector<uint32_t> moving;  // these and the scripted bodies that move, ascending
  uint32_t num_sleepers = 0;
  bool active_changed = true;  // a body was added, removed, changed its type, slept or woke

  Vector<BodyPose> keyframes;  // poses that Keyframe bodies were told

  // Broad phase: the sweep for worlds that remember nothing, the trees for all others
  Vector<BroadphaseProxy> proxies;
  Vector<ContactReach> reach;  // by body
  Vector<uint32_t> all_bodies;
  Vector<uint32_t> changed_bodies;  // added, removed or moved from outside since the last step
  SweepBroadphase sweep;
  TreeBroadphase tree;
  Vector<Pair> pairs, next_pairs;  // with a body that moves; sorted by key

  // Continuous collision, by body
  Vector<Transform> start_poses;
  Vector<Sweep> sweeps;  // by body, of those that moved in the step
  Vector<uint8_t> is_fast;
  Vector<Stop> stops;
  Vector<FastPair> fast_pairs;
  Vector<BodyPose> stopped_poses;
  bool tree_is_current = false;  // the tree holds the bodies where they are now

  // Sleep
  Vector<uint32_t> next_sleeper;  // by body: the next one of its sleeping island, in a ring
  Vector<Pair> sleeping_pairs;    // set aside; sorted by key
  bool has_woken = false;              // a body woke whose pairs are still set aside

  // Collision
  ContactStore contacts;
  CollisionDetector detector;

  // Islands, of awake bodies and of the pairs that touch
  Islands islands;
  Vector<Link> island_links;           // of contacts, then of joints
  Vector<uint32_t> island_link_pairs;  // index into pairs, by link
  Vector<uint32_t> island_pairs;       // of contacts, island by island, for IslandView

  // Joints
  JointStore joint_store;
  Vector<JointConstraint> joint_constraints;
  JointComponents joint_components;
  Vector<JointComponent*> free_components;  // awake, without contacts, solved alone
  JointStep joint_step;                          // the others
  Vector<uint8_t> jointed;                  // by body: part of an awake component
  Vector<uint8_t> since_touch;              // by body: steps since a contact touched its component, saturating
  Vector<JointId> broken_joints;            // in the last step

  // Solver
  Vector<ContactConstraint> constraints;
  Vector<uint32_t> solver_index;  // by body; kNoSolverBody when it has none, as between steps
  Vector<uint32_t> solved;        // body of each solver body
  Vector<uint32_t> free_bodies;   // active bodies without a constraint
  Vector<SolverBody> solver_bodies;
  Vector<BodyMotion> motions;
  Vector<uint8_t> solver_dynamic;
  SoftStep soft_step;

  // Islands that the island solver takes
  bool any_strained = false;       // a contact of this step is
  Islands contact_islands;         // of constraints and joints
  Deque<NewtonTask> newton_islands;
  uint32_t num_newton_islands = 0;  // in use

  // What the application says about contacts, and what it is told
  ApartPairs apart;
  PairFilter pair_filter;
  ContactModifier contact_modifier;
  Vector<ModifiedContact> modified;
  EventStore events;

  ParticleStore particle_store;

  // Meshes that were deformed
  Vector<MeshMotion> mesh_motions;
  uint64_t num_deformations = 0;
  Vector<MovingSurface> surfaces;  // of this step, by solver body after those of bodies

  Vector<StageTime> times;
  uint64_t stages_run = 0;  // a bit for each of the pipeline, since the world was made
  WorldCounts counts;
  bool counts_are_current = false, islands_are_current = false;  // of what is told about the world

  bool solves(const Pair& pair) const;
  ContactStrain strainOf(const ContactConstraint& constraint) const;  // solver_a, solver_b are indices of states
  const MeshMotion* motionOf(uint32_t body) const;  // of the moving mesh that it wears, or null
  Vec3 surfaceVelocity(uint32_t body, const ContactManifold& manifold, const MeshMotion& motion) const;  // m/s, world
  // The belt that runs over a body, or null.
  const Surface* beltOf(uint32_t body) const;
  void rescaleImpulses(float next_substep);  // so that they stand for the same forces
  void refreshActive();
  void linkIslands();
  void hasChanged(uint32_t body);      // from outside: it stands elsewhere, is new, or is gone
  QueryScene queryScene();             // for queries about the bodies as they are now
  void needSolverBody(uint32_t body);  // the solver will work on it
  void listIslands();                  // with their pairs, for those who look at them
  void forgetCounts() { counts_are_current = islands_are_current = false; }
  void forgetPairs(uint32_t body);     // with their contacts; those that last are found anew
  void wake(uint32_t body);            // and its whole island
  void wakeNeighbours(uint32_t body);  // everything that it touches
  void revivePairs();
};

inline constexpr uint32_t kNoSolverBody = 0xffffffffu;

}  // namespace pfx
