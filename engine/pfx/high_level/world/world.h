// The world: owns the bodies and the buffers of every stage, and steps them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/rigid_body/surface.h"
#include "pfx/base_level/shape/aabb.h"
#include "pfx/base_level/shape/collidable.h"
#include "pfx/base_level/simd_level.h"
#include "pfx/high_level/particles/particle_def.h"
#include "pfx/high_level/world/events.h"
#include "pfx/high_level/world/joint_def.h"
#include "pfx/low_level/ray/ray_cast.h"
#include "pfx/low_level/solver/contact_solver.h"
#include "pfx/low_level/solver/joint_constraint.h"

namespace pfx {

class ParticleSystem;  // high_level/particles/particle_system.h

// Which stages a world runs and what it keeps from step to step.
enum class Pipeline : uint8_t {
  Simple,  // pairs and contacts are made anew in every step; nothing is remembered
  Stable,  // pairs, contacts and accumulated impulses are carried from step to step
};

struct WorldDef {
  Vec3 gravity = Vec3(0.0f, -9.8f, 0.0f);  // m/s^2
  Pipeline pipeline = Pipeline::Stable;
  int substeps = 4;  // solver sub-steps a step, >= 1; error of contacts and joints falls with its square,
                     // cost of the solver rises in proportion
  JointSolver joint_solver = JointSolver::Auto;
  ContactSolver contact_solver = ContactSolver::Auto;
  Mixing friction_mixing = Mixing::GeometricMean;  // of the bodies of a pair
  Mixing restitution_mixing = Mixing::Mean;
  SimdLevel simd = SimdLevel::Auto;  // widest kernels to use; the result is the same for all
  int workers = 1;                   // threads, the caller included; the result is the same for any number
  bool sleeping = false;             // islands at rest are put to sleep
  float sleep_velocity = 0.1f;       // m/s and rad/s
  uint32_t sleep_steps = 180;        // steps below sleep_velocity before an island sleeps
  bool report_events = false;        // World::events() has something to say
  float hit_speed = 1.0f;            // m/s, of approach, beyond which the begin of a contact is a hit
  Vec3 center = Vec3::Zero();        // m, of the world box; bodies that are wholly outside collide with nothing
  Vec3 extent = Vec3::Constant(500.0f);  // m, half extent of the world box
};

struct BodyDef {
  std::string name = {};                 // for inspectors and files; need not be unique
  Transform pose = {};                   // of the centre of mass
  Vec3 linear_velocity = Vec3::Zero();   // m/s
  Vec3 angular_velocity = Vec3::Zero();  // rad/s, world axes
  MotionType motion_type = MotionType::Active;
  std::vector<Shape> shapes = {};  // at least one; offsets are relative to the centre of mass
  float mass = 1.0f;               // kg
  // kg m^2, body axes. Zero: computed from the shapes with uniform density scaled to `mass`.
  Mat3 inertia = Mat3::Zero();
  float restitution = 0.2f;
  float friction = 0.6f;
  float linear_damping = 0.0f;      // 1/s
  float angular_damping = 0.0f;     // 1/s
  float rolling_resistance = 0.0f;  // m, see RigidBody
  Surface surface = {};
  float gravity_scale = 1.0f;
  uint32_t filter_self = 0xffffffffu;
  uint32_t filter_target = 0xffffffffu;
};

struct StageTime {
  const char* name;
  double milliseconds;  // in the last step
};

// A set of awake bodies linked by contacts and joints, or one that sleeps together.
struct IslandView {
  std::span<const uint32_t> bodies;    // body indices, ascending
  std::span<const uint32_t> contacts;  // indices into contactPairs()
  uint32_t joints;                     // number of them
  bool asleep;
  float sleep_timer;  // s below the sleep velocity
};

// How the next steps are solved: the fields of that name in WorldDef.
struct SolverSettings {
  int substeps = 4;
  JointSolver joint_solver = JointSolver::Auto;
  ContactSolver contact_solver = ContactSolver::Auto;
  bool operator==(const SolverSettings&) const = default;
};

// What solved an island in the last step.
struct IslandSolvers {
  bool newton = false;         // contacts, or some of them: Newton's method; else sequential impulses
  bool direct_joints = false;  // joints, or some of them: block elimination
  bool soft_joints = false;    // joints, or some of them: soft rows
};

// A box of the trees that find pairs, for views.
struct TreeBox {
  Aabb bounds;     // m
  uint32_t level;  // 0: what a root holds
  bool is_leaf;    // of one body
};

struct WorldCounts {
  uint32_t bodies = 0, awake = 0, pairs = 0, touching_pairs = 0, contact_points = 0, islands = 0, joints = 0;
};

class World {
 public:
  // With a block (aligned to BlockMemory::kAlignment, outliving the world) everything that the world makes lies in it:
  // bodies, joints, and the buffers of all stages. Meshes and particle systems bring memory of their own, and so do
  // threads. Throws std::length_error for a block that cannot even hold an empty world.
  explicit World(const WorldDef& def = {}, std::span<std::byte> block = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // Bytes of the block that a world needs which is built and stepped as this one was, on the heap or not: with one worker
  // exactly, with more to what their scratch buffers differ by. A trial run tells how large to make a block.
  size_t memoryBytes() const;

  const WorldDef& def() const;

  // Solves the next steps otherwise; what was remembered of the last ones stays. Throws std::invalid_argument for less
  // than one sub-step.
  void setSolver(const SolverSettings& settings);
  SolverSettings solver() const;

  // Takes effect in the next step. Wakes all bodies when it is another gravity than before. Throws std::invalid_argument
  // for one that is not finite.
  void setGravity(const Vec3& gravity);  // m/s^2

  // Moves or resizes the world box from the next step on, and wakes all bodies when that changes it. Throws
  // std::invalid_argument for a half extent that is not positive, or what is not finite.
  void setBox(const Vec3& center, const Vec3& extent);  // m; half extent

  // Takes a mesh into the world's keeping, so that shapes may point at it for as long as the world lives.
  const ConvexMesh* keep(ConvexMesh mesh);
  LargeMesh* keep(LargeMesh mesh);

  // Moves the vertices of a kept mesh, which only Fixed and Keyframe bodies of one shape wear, to `vertices` (as many as
  // it was built from; mesh frame). Contacts on it follow their triangles, and a body that the surface would swallow is
  // set upon it. The motion is taken to have lasted dt seconds: in the next step contacts know the velocity of the
  // surface, so that it carries and throws; with 0 the surface jumps and throws nothing. Throws std::invalid_argument
  // for another number of vertices, one that is not finite, or a mesh that is not kept or part of another kind of body.
  void deformMesh(const LargeMesh* mesh, std::span<const Vec3> vertices, float dt);
  uint64_t deformations() const;  // how often that was done, for views that keep meshes

  // Adds a body. Throws std::invalid_argument, naming the body and the field, for input that is not finite,
  // has no shape, or a mass that is not positive.
  BodyId addBody(const BodyDef& def);
  void removeBody(BodyId id);
  bool isValid(BodyId id) const;

  // Gives a body other shapes (at least one), relative to the same centre of mass; mass and inertia stay. Wakes its
  // island, and its contacts are found anew. Throws std::invalid_argument for a shape that addBody() would refuse.
  void setShapes(BodyId id, std::span<const Shape> shapes);
  BodyId bodyId(uint32_t index) const;

  // Advances by dt seconds (>= 0). Throws std::invalid_argument when dt is negative or not finite, and std::length_error,
  // with the bytes that are needed, when the block of the world is too small; the step is done nevertheless, with the rest
  // on the heap.
  void step(float dt);
  uint64_t stepCount() const;

  // Arrays by body index; removed bodies are Fixed, have no shape and lie outside the world.
  std::span<const RigidState> states() const;
  std::span<const RigidBody> bodies() const;
  std::span<const Collidable> collidables() const;
  std::string_view name(uint32_t index) const;

  // Mutable access between steps. Wakes the island of the body.
  RigidState& state(BodyId id);
  RigidBody& body(BodyId id);

  // What of its surface few bodies have. Throws std::invalid_argument for what addBody() would refuse.
  Surface surface(uint32_t index) const;
  void setSurface(BodyId id, const Surface& surface);

  // Moves a Keyframe body: it reaches `pose` at the end of the next step of dt seconds.
  void moveKeyframe(BodyId id, const Transform& pose, float dt);

  // Adds a joint between two bodies where they stand. Throws std::invalid_argument, naming the joint, when a
  // body does not exist, both are the same, or a parameter lies outside its range.
  JointId addJoint(const JointDef& def);
  void removeJoint(JointId id);
  bool isValid(JointId id) const;
  JointId jointId(uint32_t index) const;

  // Arrays by joint index; a removed joint has no constrained axis.
  std::span<const Joint> joints() const;
  std::span<const JointLink> jointLinks() const;
  std::string_view jointName(uint32_t index) const;
  JointStrength jointStrength(uint32_t index) const;

  // Mutable access between steps, to change limits, motors, springs, or the kind. Wakes both bodies.
  Joint& joint(JointId id);

  // How far the joint is from what it holds.
  JointError jointError(uint32_t index) const;

  // Joints that broke in the last step; they are removed already.
  std::span<const JointId> brokenJoints() const;

  // Pairs that do not collide, besides those of joints, until told otherwise or one of the bodies is removed. Both wake.
  // Throw std::invalid_argument when a body does not exist or both are the same.
  void keepApart(BodyId a, BodyId b);
  void letCollide(BodyId a, BodyId b);
  bool areKeptApart(BodyId a, BodyId b) const;
  std::vector<Pair> pairsKeptApart() const;  // ascending

  // What happened in the last step, and between it and the one before. Empty without WorldDef::report_events, except for
  // broken joints.
  WorldEvents events() const;

  // What the application has to say about contacts before they are solved (events.h); an empty function: nothing. Not
  // part of snapshots and files. A function must answer the same for the same bodies in the same state, or runs differ,
  // and must not change the world.
  void setPairFilter(PairFilter filter);
  void setContactModifier(ContactModifier modifier);

  // Adds a system of particles, which is stepped with the world, after its bodies. Throws std::invalid_argument, naming
  // the system and what is wrong with it. When a body is removed, particles anchored to it fly free; those without a
  // mass stay where they are.
  ParticlesId addParticles(const ParticleDef& def);
  void removeParticles(ParticlesId id);
  bool isValid(ParticlesId id) const;
  ParticlesId particlesId(uint32_t index) const;
  uint32_t numParticleSystems() const;                      // removed ones included
  const ParticleSystem* particles(uint32_t index) const;  // null when it was removed
  ParticleSystem& particles(ParticlesId id);

  // Queries about the bodies as they are now. The first one after a step or a change brings the tree up to
  // date; after that any number of threads may ask at once until the next change.
  RayOutput castRay(const RayInput& ray) const;  // nearest hit; among equals the lowest body, then shape
  // outputs[i] = castRay(rays[i]), shared out over the workers. Error::OutOfRange for spans of different
  // length.
  Error castRays(std::span<const RayInput> rays, std::span<RayOutput> outputs) const;
  ShapeCastOutput castShape(const ShapeCastInput& input) const;
  // Appends the bodies that overlap the convex shape, ascending.
  void findOverlaps(const OverlapInput& input, std::vector<uint32_t>& bodies) const;

  // Pairs whose bounds met in the last step, by key; contact_id + k (k < count) indexes manifolds().
  std::span<const Pair> contactPairs() const;
  std::span<const ContactManifold> manifolds(const Pair& pair) const;

  uint32_t numIslands() const;
  IslandView island(uint32_t index) const;
  IslandSolvers islandSolvers(uint32_t index) const;

  // Boxes of the trees that find pairs, as the last step left them; empty in a Simple world.
  std::vector<TreeBox> treeBoxes() const;
  // The axis (0, 1, 2) along which a Simple world sorts its bodies to find pairs; -1 in worlds that have trees.
  int sweepAxis() const;

  WorldCounts counts() const;  // counted once after each step or change
  std::span<const StageTime> stageTimes() const;  // of the last step, in order
  std::vector<std::string_view> stages() const;   // that this world has run since it was made, in order
  // Everything that the world needs to continue to the bit, meshes included, as portable bytes (snapshot.h). snapshot()
  // returns how many it wrote. restore() goes back to them, or takes over those of another world; the number of
  // workers and the SIMD level stay, ids and the addresses of meshes stay valid. Both throw SnapshotError, snapshot()
  // when the buffer is too short or a mesh is not kept by the world; after an error the world is as it was.
  size_t snapshotBytes() const;
  size_t snapshot(std::span<std::byte> out) const;
  void restore(std::span<const std::byte> in);

  uint64_t stateHash() const;                     // of all bodies and particles, bit-exact

  struct Impl;  // the stages of high_level/pipeline work on it

 private:
  struct Destroy {
    void operator()(Impl* impl) const;
  };
  void requireRoom() const;  // throws std::length_error
  std::unique_ptr<Impl, Destroy> impl_;
};

}  // namespace pfx
