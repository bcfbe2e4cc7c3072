#include "pfx/high_level/world/world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"
#include "pfx/util/state_hash/state_hash.h"

namespace pfx {

bool World::Impl::solves(const Pair& pair) const {
  const RigidState &a = store.states[pair.body_a], &b = store.states[pair.body_b];
  if (!solvesConstraint(a.motion_type, b.motion_type)) return false;
  return (isDynamic(a.motion_type) && !a.asleep) || (isDynamic(b.motion_type) && !b.asleep);
}

void World::Impl::refreshActive() {
  if (!active_changed) return;
  active.clear();
  moving.clear();
  num_sleepers = 0;
  for (uint32_t i = 0; i < store.states.size(); ++i) {
    const RigidState& s = store.states[i];
    num_sleepers += s.asleep;
    if (!store.exists(i) || !moves(s)) continue;
    moving.push_back(i);
    if (isDynamic(s.motion_type)) active.push_back(i);
  }
  active_changed = false;
}

void World::Impl::hasChanged(uint32_t body) {
  active_changed = true;
  tree_is_current = false;
  forgetCounts();
  changed_bodies.push_back(body);
}

void World::Impl::forgetPairs(uint32_t body) {
  for (auto* list : {&pairs, &sleeping_pairs}) {
    std::erase_if(*list, [&](const Pair& p) {
      if (p.body_a != body && p.body_b != body) return false;
      contacts.remove(p.contact_id);
      return true;
    });
  }
}

// Islands are made when somebody asks: for sleep, or to look at.
void World::Impl::linkIslands() {
  refreshActive();
  island_links.clear();
  island_link_pairs.clear();
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    if (!solves(pairs[i]) || contacts.manifolds(pairs[i].contact_id).empty()) continue;
    island_links.push_back({pairs[i].body_a, pairs[i].body_b});
    island_link_pairs.push_back(i);
  }
  for (const JointLink& j : joint_store.links) {
    if (j.exists && solvesConstraint(store.states[j.body_a].motion_type, store.states[j.body_b].motion_type))
      island_links.push_back({j.body_a, j.body_b});
  }
  islands.build(store.states, island_links);
}

// The links of all islands, in the order in which the islands keep them, as indices of pairs.
void World::Impl::listIslands() {
  if (std::exchange(islands_are_current, true)) return;
  const MemoryScope scope(memory);
  linkIslands();
  island_pairs.clear();
  for (uint32_t k = 0; k < islands.size(); ++k)
    for (uint32_t link : islands.links(k))
      island_pairs.push_back(link < island_link_pairs.size() ? island_link_pairs[link] : 0);
}

const WorldDef& World::def() const { return impl_->def; }

const ConvexMesh* World::keep(ConvexMesh mesh) { return &impl_->convex_meshes.emplace_back(std::move(mesh)); }
LargeMesh* World::keep(LargeMesh mesh) { return &impl_->large_meshes.emplace_back(std::move(mesh)); }

BodyId World::addBody(const BodyDef& def) {
  const MemoryScope scope(impl_->memory);
  const BodyId id = impl_->store.add(def);
  impl_->hasChanged(id.index);
  if (id.index < impl_->since_touch.size()) impl_->since_touch[id.index] = kLongSinceTouch;
  return id;
}

void World::removeBody(BodyId id) {
  if (!isValid(id)) return;
  const MemoryScope scope(impl_->memory);
  impl_->wake(id.index);
  impl_->wakeNeighbours(id.index);
  impl_->forgetPairs(id.index);
  for (uint32_t i = 0; i < impl_->joint_store.links.size(); ++i) {
    const JointLink& link = impl_->joint_store.links[i];
    if (link.exists && (link.body_a == id.index || link.body_b == id.index)) removeJoint(jointId(i));
  }
  impl_->apart.forgetBody(id.index);
  impl_->particle_store.forgetBody(id.index);
  impl_->store.remove(id.index);
  impl_->hasChanged(id.index);
}

void World::setShapes(BodyId id, std::span<const Shape> shapes) {
  const MemoryScope scope(impl_->memory);
  state(id);
  impl_->store.setShapes(id.index, shapes);
  impl_->forgetPairs(id.index);
}

bool World::isValid(BodyId id) const { return id && impl_->store.isValid(id); }

BodyId World::bodyId(uint32_t index) const { return {index, impl_->store.generations.at(index)}; }

void World::step(float dt) {
  if (!(dt >= 0.0f) || !std::isfinite(dt))
    throw std::invalid_argument("world: dt = " + std::to_string(dt) + " s, must be >= 0");
  if (dt == 0.0f) return;
  const MemoryScope scope(impl_->memory);
  impl_->dt = dt;
  impl_->rescaleImpulses(dt / static_cast<float>(impl_->def.substeps));
  runStages(*impl_);
  impl_->forgetCounts();
  ++impl_->step_count;
  requireRoom();
}

uint64_t World::stepCount() const { return impl_->step_count; }
std::span<const RigidState> World::states() const { return impl_->store.states; }
std::span<const RigidBody> World::bodies() const { return impl_->store.bodies; }
std::span<const Collidable> World::collidables() const { return impl_->store.collidables; }
std::string_view World::name(uint32_t index) const { return impl_->store.names.at(index); }

RigidState& World::state(BodyId id) {
  if (!isValid(id)) throw std::invalid_argument("world: the body does not exist");
  impl_->wake(id.index);
  impl_->wakeNeighbours(id.index);
  impl_->hasChanged(id.index);
  return impl_->store.states[id.index];
}

RigidBody& World::body(BodyId id) {
  state(id);
  return impl_->store.bodies[id.index];
}

Surface World::surface(uint32_t index) const { return impl_->store.surface(index); }

void World::setSurface(BodyId id, const Surface& surface) {
  state(id);
  impl_->store.setSurface(id.index, surface);
}

void World::moveKeyframe(BodyId id, const Transform& pose, float dt) {
  RigidState& s = state(id);
  if (s.motion_type != MotionType::Keyframe)
    throw std::invalid_argument("world: only Keyframe bodies follow a pose");
  impl_->keyframes.push_back({id.index, pose});
  s.linear_velocity = (pose.position - s.position) / dt;
  Quat turn = pose.orientation * s.orientation.conjugate();
  if (turn.w() < 0.0f) turn.coeffs() = -turn.coeffs();
  const float sine = turn.vec().norm();
  s.angular_velocity =
      sine == 0.0f ? Vec3(Vec3::Zero()) : Vec3(2.0f * atan2(sine, turn.w()) / (sine * dt) * turn.vec());
}

JointId World::addJoint(const JointDef& def) {
  const MemoryScope scope(impl_->memory);
  if (!isValid(def.body_a) || !isValid(def.body_b))
    throw std::invalid_argument("joint \"" + def.name + "\": a body does not exist");
  if (def.body_a == def.body_b) throw std::invalid_argument("joint \"" + def.name + "\": both bodies are the same");
  impl_->wake(def.body_a.index);
  impl_->wake(def.body_b.index);
  impl_->revivePairs();
  impl_->forgetCounts();
  const auto states = impl_->store.states.begin();
  return impl_->joint_store.add(def, makeJoint(states[def.body_a.index], states[def.body_b.index], def.params));
}

void World::removeJoint(JointId id) {
  if (!isValid(id)) return;
  const JointLink link = impl_->joint_store.links[id.index];
  impl_->wake(link.body_a);
  impl_->wake(link.body_b);
  impl_->revivePairs();
  impl_->forgetCounts();
  impl_->joint_store.remove(id.index);
}

bool World::isValid(JointId id) const { return impl_->joint_store.isValid(id); }
JointId World::jointId(uint32_t index) const { return {index, impl_->joint_store.generations.at(index)}; }
std::span<const Joint> World::joints() const { return impl_->joint_store.joints; }
std::span<const JointLink> World::jointLinks() const { return impl_->joint_store.links; }
std::string_view World::jointName(uint32_t index) const { return impl_->joint_store.names.at(index); }
JointStrength World::jointStrength(uint32_t index) const {
  return {impl_->joint_store.break_force.at(index), impl_->joint_store.break_torque.at(index)};
}
std::span<const JointId> World::brokenJoints() const { return impl_->broken_joints; }

void World::keepApart(BodyId a, BodyId b) {
  state(a), state(b);
  if (a == b) throw std::invalid_argument("world: a body cannot be kept apart from itself");
  impl_->apart.add(a.index, b.index);
}

void World::letCollide(BodyId a, BodyId b) {
  state(a), state(b);
  impl_->apart.remove(a.index, b.index);
}

bool World::areKeptApart(BodyId a, BodyId b) const {
  return isValid(a) && isValid(b) && impl_->apart.contains(a.index, b.index);
}

std::vector<Pair> World::pairsKeptApart() const {
  std::vector<Pair> out;
  for (uint64_t key : impl_->apart.keys())
    out.push_back({.body_a = static_cast<uint32_t>(key >> 32), .body_b = static_cast<uint32_t>(key)});
  return out;
}

WorldEvents World::events() const {
  const EventStore& e = impl_->events;
  return {.touch_begin = e.begin,
          .touch_end = e.end,
          .hits = e.hits,
          .trigger_enter = e.enter,
          .trigger_leave = e.leave,
          .fell_asleep = e.fell_asleep,
          .woke = e.woke,
          .broken_joints = impl_->broken_joints};
}

void World::setPairFilter(PairFilter filter) { impl_->pair_filter = std::move(filter); }
void World::setContactModifier(ContactModifier modifier) { impl_->contact_modifier = std::move(modifier); }

Joint& World::joint(JointId id) {
  if (!isValid(id)) throw std::invalid_argument("world: the joint does not exist");
  const JointLink& link = impl_->joint_store.links[id.index];
  impl_->wake(link.body_a);
  impl_->wake(link.body_b);
  impl_->revivePairs();
  return impl_->joint_store.joints[id.index];
}

JointError World::jointError(uint32_t index) const {
  const JointLink& link = impl_->joint_store.links.at(index);
  const auto pose = [&](uint32_t body) { return toDouble(impl_->store.states[body].pose()); };
  return pfx::jointError(impl_->joint_store.joints[index], pose(link.body_a), pose(link.body_b));
}

QueryScene World::Impl::queryScene() {
  const MemoryScope scope(memory);
  refreshActive();
  if (!tree_is_current) stage::updateTree(*this);
  tree_is_current = true;
  return {.states = store.states, .collidables = store.collidables, .tree = &tree};
}

RayOutput World::castRay(const RayInput& ray) const { return pfx::castRay(ray, impl_->queryScene()); }

Error World::castRays(std::span<const RayInput> rays, std::span<RayOutput> outputs) const {
  return pfx::castRays(rays, impl_->queryScene(), outputs, &impl_->tasks);
}

ShapeCastOutput World::castShape(const ShapeCastInput& input) const {
  return pfx::castShape(input, impl_->queryScene());
}

void World::findOverlaps(const OverlapInput& input, std::vector<uint32_t>& bodies) const {
  pfx::findOverlaps(input, impl_->queryScene(), bodies);
}

std::span<const Pair> World::contactPairs() const { return impl_->pairs; }

std::span<const ContactManifold> World::manifolds(const Pair& pair) const {
  return std::as_const(impl_->contacts).manifolds(pair.contact_id);
}

uint32_t World::numIslands() const {
  impl_->listIslands();
  return impl_->islands.size();
}

IslandView World::island(uint32_t index) const {
  impl_->listIslands();
  const auto bodies = impl_->islands.bodies(index);
  const auto& states = impl_->store.states;
  const auto restless = [&](uint32_t a, uint32_t b) { return states[a].sleep_count < states[b].sleep_count; };
  const RigidState& least_rested = states[*std::min_element(bodies.begin(), bodies.end(), restless)];
  const auto links = impl_->islands.links(index);
  const auto first_joint = std::lower_bound(links.begin(), links.end(), impl_->island_link_pairs.size());
  const auto num_contacts = static_cast<size_t>(first_joint - links.begin());
  const auto offset = static_cast<size_t>(links.data() - impl_->islands.links(0).data());
  return {.bodies = bodies,
          .contacts = std::span(impl_->island_pairs).subspan(offset, num_contacts),
          .joints = static_cast<uint32_t>(links.size() - num_contacts),
          .asleep = least_rested.asleep,
          .sleep_timer = static_cast<float>(least_rested.sleep_count) * impl_->dt};
}

WorldCounts World::counts() const {
  WorldCounts& c = impl_->counts;
  if (std::exchange(impl_->counts_are_current, true)) return c;
  impl_->refreshActive();
  c = {};
  c.bodies = impl_->store.count();
  c.awake = static_cast<uint32_t>(impl_->active.size());
  c.pairs = static_cast<uint32_t>(impl_->pairs.size());
  for (const Pair& p : impl_->pairs) {
    const auto found = manifolds(p);
    c.touching_pairs += !found.empty();
    for (const ContactManifold& m : found) c.contact_points += static_cast<uint32_t>(m.num_points);
  }
  c.islands = numIslands();
  c.joints = impl_->joint_store.count();
  return c;
}

std::span<const StageTime> World::stageTimes() const { return impl_->times; }

std::vector<std::string_view> World::stages() const {
  std::vector<std::string_view> names;
  uint64_t bit = 1;
  for (const Stage& s : pfx::stages(impl_->def.pipeline))
    if (impl_->stages_run & std::exchange(bit, bit << 1)) names.push_back(s.name);
  return names;
}

uint64_t World::stateHash() const { return impl_->particle_store.hash(hashStates(impl_->store.states)); }

}  // namespace pfx
